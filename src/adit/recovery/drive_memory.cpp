#include "adit/recovery/drive_memory.hpp"

#include <algorithm>

namespace adit {
namespace {

/// A covariance over (x, y, theta) in axes turned by this.
Matrix3d turned(const Matrix3d& covariance, double by) {
  Matrix3d turn = Matrix3d::Identity();
  turn.col(0).head<2>() = unit_vector(by);
  turn.col(1).head<2>() = perpendicular(unit_vector(by));
  return turn * covariance * turn.transpose();
}

}  // namespace

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

/// The pose before a move that dead reckoning knows with some error.
PoseWithCovariance DriveMemory::before(const PoseWithCovariance& after, const Way& way) {
  const PoseWithCovariance& moved = way.tracker.estimate();
  PoseWithCovariance at = carry(after, inverse(moved.pose));
  at.covariance += turned(moved.covariance, at.pose.theta);
  return at;
}

Retrospect DriveMemory::look_back(const PoseWithCovariance& map_from_vehicle, const FitRules& rules,
                                  double sure_evidence_ratio, Refiner& refiner) const {
  Retrospect out;
  PoseWithCovariance at = map_from_vehicle;
  bool goes_on = true;
  int contradicted = 0;
  double way_m = 0.0;
  for (auto kept = scans_.rbegin(); kept != scans_.rend(); ++kept) {
    way_m += kept->since.metres;
    at = before(at, kept->since);
    const PoseWithCovariance start = loosened(at);
    const RefinementInput input{rules.map, kept->scan, kept->scanner, kept->map_error,
                                kept->motion};
    const ScanFit& fit = refiner.refine(input, start, start, rules.refinement);
    const Testimony says = testimony_of(fit, rules.status, sure_evidence_ratio);
    if (says == Testimony::blind) {
      out.witnesses.emplace_back();
      continue;
    }
    out.witnesses.push_back(witness_of(fit));
    contradicted = says == Testimony::contradicts ? contradicted + 1 : 0;
    out.contradicted = std::max(out.contradicted, contradicted);
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
