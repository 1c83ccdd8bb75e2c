#include "adit/survey/walls.hpp"

#include <cmath>

#include "adit/survey/visits.hpp"
#include "adit/survey/wall_chains.hpp"
#include "adit/survey/wall_ends.hpp"
#include "adit/survey/wall_polyline.hpp"

namespace adit {
namespace {

constexpr double kShareOfAdding = 0.45;  // of the time, for the progress
constexpr double kShareOfLooking = 0.45;
constexpr std::size_t kReportEvery = 64;  // scans

}  // namespace

std::vector<Segment> WallMap::segments() const {
  std::vector<Segment> out;
  for (const SurveyedWallLine& line : lines) {
    for (const SurveyedWall& piece : line.pieces) out.push_back(piece.segment);
  }
  return out;
}

Result<WallMap> survey_walls(const PosedScans& scans, const ScannerModel& scanner,
                             const WallOptions& given, std::span<const int> visits,
                             const SurveyProgress& progress) {
  WallOptions options = given;
  options.cell_m = cell_size(scanner, given);
  std::size_t done = 0;
  const auto report = [&](double from, double share) {
    if (progress && done % kReportEvery == 0) {
      progress(from + share * static_cast<double>(done) / static_cast<double>(scans.size()));
    }
    ++done;
  };
  BeamEvidence evidence(scanner, options);
  WallHitFinder finder(scanner, options);
  Visits adding(visits, options.visit_m);
  const auto added = scans.visit([&](const PosedScan& scan) {
    report(0.0, kShareOfAdding);
    evidence.add(finder.find(scan), adding.next(scan.map_from_vehicle));
  });
  if (!added) return tl::unexpected(added.error());
  evidence.finish_adding();
  done = 0;
  Visits looking(visits, options.visit_m);
  const auto looked = scans.visit([&](const PosedScan& scan) {
    report(kShareOfAdding, kShareOfLooking);
    evidence.look_through(scan, looking.next(scan.map_from_vehicle));
  });
  if (!looked) return tl::unexpected(looked.error());
  evidence.finish_looking();

  const std::vector<WallNode> nodes = find_wall_nodes(evidence, scanner, options);
  WallMap map;
  for (const WallChain& chain : link_wall_nodes(nodes, evidence, options)) {
    if (auto line = make_wall_line(nodes, chain, options)) map.lines.push_back(std::move(*line));
  }
  join_ends(map.lines, evidence, options);
  if (progress) progress(1.0);
  return map;
}

WallMap survey_walls(std::span<const PosedScan> scans, const ScannerModel& scanner,
                     const WallOptions& options, std::span<const int> visits,
                     const SurveyProgress& progress) {
  return survey_walls(PosedScanList(scans), scanner, options, visits, progress).value();
}

}  // namespace adit
