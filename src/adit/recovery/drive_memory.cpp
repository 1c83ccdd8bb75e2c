#include "adit/recovery/drive_memory.hpp"

#include <algorithm>

#include "adit/geometry/uncertain_move.hpp"

namespace adit {

void DriveMemory::predict(const Pose2& move, const OdometryNoise& noise,
                          const TrackingOptions& options) {
  if (scans_.empty()) return;
  Way& way = scans_.back().since;
  way.tracker.predict(move, noise, options);
  way.metres += move.translation().norm();
}

void DriveMemory::blur(double metres, double radians) {
  if (!scans_.empty()) scans_.back().since.tracker.blur(metres, radians);
}

void DriveMemory::add(const RefinementInput& input, const DriveMemoryOptions& options) {
  if (!scans_.empty() && scans_.back().since.metres < options.spacing_m) return;
  Kept& kept =
      scans_.emplace_back(Kept{input.scan, input.scanner, input.map_error, input.motion, Way{}});
  kept.since.tracker.start({});
  while (static_cast<int>(scans_.size()) > std::max(1, options.most_scans)) scans_.pop_front();
}

Retrospect DriveMemory::look_back(const PoseWithCovariance& map_from_vehicle, const FitRules& rules,
                                  double sure_evidence_ratio, Refiner& refiner,
                                  int scans_to_refute) const {
  Retrospect out;
  PoseWithCovariance at = map_from_vehicle;
  bool goes_on = true;
  int contradicted = 0;
  double way_m = 0.0;
  for (std::size_t i = scans_.size(); i-- > 0;) {
    const Kept& kept = scans_[i];
    way_m += kept.since.metres;
    at = moved_by(at, inverse(kept.since.tracker.estimate()));
    const PoseWithCovariance start = loosened(at);
    const RefinementInput input{rules.map, kept.scan, kept.scanner, kept.map_error, kept.motion};
    const ScanFit& fit = refiner.refine(input, start, start, rules.refinement);
    const Testimony says = testimony_of(fit, rules.status, sure_evidence_ratio);
    if (says == Testimony::blind) {
      out.witnesses.emplace_back();
      continue;
    }
    out.witnesses.push_back(witness_of(fit));
    contradicted = says == Testimony::contradicts ? contradicted + 1 : 0;
    out.contradicted = std::max(out.contradicted, contradicted);
    if (out.contradicted >= scans_to_refute) break;
    goes_on = goes_on && (says == Testimony::sure || says == Testimony::open);
    if (goes_on && says == Testimony::sure) {
      ++out.explained;
      out.explained_m = way_m;
    }
    if (says == Testimony::contradicts) continue;
    PoseTracker tracker;
    tracker.start(at);
    tracker.update(observation_of(fit), rules.tracking);
    at = tracker.estimate();
  }
  return out;
}

}  // namespace adit
