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
constexpr std::size_t kTogether = 32;     // scans of a place at most whose beams are neighbours
constexpr std::size_t kReportEvery = 64;  // scans

/// Turns scans into hits for the evidence.
class HitAdder {
 public:
  HitAdder(const ScannerModel& scanner, const WallOptions& options, BeamEvidence& evidence)
      : scans_(scanner, options), places_(scanner, options), evidence_(evidence) {}

  void add(const PosedScan& scan, int visit) { evidence_.add(scans_.find(scan), visit); }

  /// Of a scan whose visit is a place: it waits for the others from there.
  void add_of_place(const PosedScan& scan, int visit) {
    if (!place_.empty() && (visit != visit_ || place_.size() == kTogether)) finish();
    visit_ = visit;
    place_.push_back(scan);
  }
  void finish() {
    if (place_.empty()) return;
    for (const std::vector<WallHit>& hits : places_.find(place_)) evidence_.add(hits, visit_);
    place_.clear();
  }

 private:
  WallHitFinder scans_;
  PlaceHitFinder places_;
  BeamEvidence& evidence_;
  std::vector<PosedScan> place_;
  int visit_ = 0;
};

}  // namespace

std::vector<Segment> WallMap::segments() const {
  std::vector<Segment> out;
  for (const SurveyedWallLine& line : lines) {
    for (const SurveyedWall& piece : line.pieces) out.push_back(piece.segment);
  }
  return out;
}

Result<WallMap> survey_walls(const PosedScans& scans, const ScannerModel& scanner,
                             const WallOptions& options, std::span<const int> visits,
                             const SurveyProgress& progress) {
  WallOptions here = options;
  here.cell_m = cell_size(scanner, options);
  if (visits.size() != scans.size()) visits = {};
  std::size_t done = 0;
  const auto report = [&](double from, double share) {
    if (progress && done % kReportEvery == 0) {
      progress(from + share * static_cast<double>(done) / static_cast<double>(scans.size()));
    }
    ++done;
  };
  BeamEvidence evidence(scanner, here);
  HitAdder hits(scanner, here, evidence);
  Visits adding(visits, here.visit_m);
  const bool by_place = !visits.empty();
  const auto added = scans.visit([&](const PosedScan& scan) {
    report(0.0, kShareOfAdding);
    const int visit = adding.next(scan.map_from_vehicle);
    by_place ? hits.add_of_place(scan, visit) : hits.add(scan, visit);
  });
  if (!added) return tl::unexpected(added.error());
  hits.finish();
  evidence.finish_adding();
  done = 0;
  Visits looking(visits, here.visit_m);
  const auto looked = scans.visit([&](const PosedScan& scan) {
    report(kShareOfAdding, kShareOfLooking);
    evidence.look_through(scan, looking.next(scan.map_from_vehicle));
  });
  if (!looked) return tl::unexpected(looked.error());
  evidence.finish_looking();

  const std::vector<WallNode> nodes = find_wall_nodes(evidence, scanner, here);
  WallMap map;
  for (const WallChain& chain : link_wall_nodes(nodes, evidence, here)) {
    if (auto line = make_wall_line(nodes, chain, here)) map.lines.push_back(std::move(*line));
  }
  join_ends(map.lines, evidence, here);
  if (progress) progress(1.0);
  return map;
}

WallMap survey_walls(std::span<const PosedScan> scans, const ScannerModel& scanner,
                     const WallOptions& options, std::span<const int> visits,
                     const SurveyProgress& progress) {
  return survey_walls(PosedScanList(scans), scanner, options, visits, progress).value();
}

}  // namespace adit
