#include "adit/survey/walls.hpp"

#include <cmath>

#include "adit/survey/wall_chains.hpp"
#include "adit/survey/wall_ends.hpp"
#include "adit/survey/wall_polyline.hpp"

namespace adit {
namespace {

constexpr double kShareOfAdding = 0.45;  // of the time, for the progress
constexpr double kShareOfLooking = 0.45;
constexpr std::size_t kReportEvery = 64;  // scans
// Of a visit's way: less is not counted until it adds up to that in a straight line, so that the
// jitter of a machine that stands makes no visits.
constexpr double kStride = 0.1;

}  // namespace

std::vector<Segment> WallMap::segments() const {
  std::vector<Segment> out;
  for (const SurveyedWallLine& line : lines) {
    for (const SurveyedWall& piece : line.pieces) out.push_back(piece.segment);
  }
  return out;
}

std::vector<int> visits_by_way(std::span<const PosedScan> scans, double visit_m) {
  const double stride = kStride * visit_m;
  std::vector<int> visits;
  double way = 0.0;
  Vector2d last = scans.empty() ? Vector2d(0.0, 0.0) : scans[0].map_from_vehicle.translation();
  for (const PosedScan& scan : scans) {
    const Vector2d here = scan.map_from_vehicle.translation();
    if ((here - last).norm() >= stride) {
      way += (here - last).norm();
      last = here;
    }
    visits.push_back(static_cast<int>(way / visit_m));
  }
  return visits;
}

WallMap survey_walls(std::span<const PosedScan> scans, const ScannerModel& scanner,
                     const WallOptions& given, std::span<const int> visits,
                     const SurveyProgress& progress) {
  WallOptions options = given;
  options.cell_m = cell_size(scanner, given);
  std::vector<int> by_way;
  if (visits.size() != scans.size()) {
    by_way = visits_by_way(scans, options.visit_m);
    visits = by_way;
  }
  const auto report = [&](std::size_t i, double from, double share) {
    if (progress && i % kReportEvery == 0) {
      progress(from + share * static_cast<double>(i) / static_cast<double>(scans.size()));
    }
  };
  BeamEvidence evidence(scanner, options);
  WallHitFinder finder(scanner, options);
  for (std::size_t i = 0; i < scans.size(); ++i) {
    report(i, 0.0, kShareOfAdding);
    evidence.add(finder.find(scans[i]), visits[i]);
  }
  evidence.finish_adding();
  for (std::size_t i = 0; i < scans.size(); ++i) {
    report(i, kShareOfAdding, kShareOfLooking);
    evidence.look_through(scans[i], visits[i]);
  }
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

}  // namespace adit
