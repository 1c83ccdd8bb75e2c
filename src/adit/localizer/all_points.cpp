// The stage that fits all points: which of several poses near the prediction explains the scan.

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "adit/localizer/localizer.hpp"
#include "adit/relocation/fit_quality.hpp"

namespace adit {

/// All points of the scan against the map, from where the features say or, without them, from the
/// prediction.
void Localizer::refine_pose(const LaserScan& scan) {
  if (!uses_points() || is_anywhere_) return;
  const RefinementInput input{map_, scan, scanner_, map_error_.error(), motion_};
  std::optional<ScanFit> rival_fit;
  PoseWithCovariance start{predicted_.pose, floored(predicted_.covariance)};
  {
    const Stopwatch watch(timings_.refinement);
    if (rival_) rival_fit = refine_rival(input);
    if (uses_features_ && features_are_believable()) start = vehicle_by_features();
    scan_fit_ = refine_from(input, start);
  }
  if (is_poor(scan_fit_)) search(input, start);
  if (rival_fit) weigh_rival(input, *rival_fit);
}

/// As a prior: slipping wheels may have spoilt it beyond its covariance.
PoseWithCovariance Localizer::loose(const PoseWithCovariance& prediction) const {
  return {prediction.pose, settings_.localizer.prior_inflation * floored(prediction.covariance)};
}

const ScanFit& Localizer::refine_from(const RefinementInput& input,
                                      const PoseWithCovariance& start) {
  return refiner_.refine(input, loose(predicted_), start, settings_.refinement);
}

bool Localizer::is_poor(const ScanFit& fit) const {
  const SearchOptions& options = settings_.search;
  const FitQuality quality = quality_of(fit);
  const Vector3d off = difference(predicted_.pose, fit.pose);
  const double asked = std::min(
      options.poor_evidence_ratio + options.poor_evidence_per_behind * quality.behind_ratio,
      options.most_poor_evidence_ratio);
  return !quality.converged || quality.evidence_ratio < asked || has_lost_direction(fit) ||
         off.dot(floored(predicted_.covariance).inverse() * off) > options.poor_chi_square;
}

/// Whether the scan leaves a direction open that the last one showed: what showed it may be in
/// sight still, but too far from where this fit expects it.
bool Localizer::has_lost_direction(const ScanFit& fit) const {
  return !estimate_.dead_reckoned && !estimate_.open_direction &&
         open_direction(fix_covariance(fit.information), settings_.status).has_value();
}

/// The most plausible fit near the prediction: the first one, those from the features and from the
/// prediction itself, and the one from the best of a lattice around it. Another that is about as
/// plausible becomes a rival.
void Localizer::search(const RefinementInput& input, const PoseWithCovariance& first) {
  const PoseWithCovariance prediction{predicted_.pose, floored(predicted_.covariance)};
  std::array<PoseWithCovariance, 3> starts;
  std::size_t count = 0;
  starts[count++] = first;
  if (uses_features_ && features_are_believable()) {
    starts[count++] = prediction;  // the first fit began at the features
  } else if (settings_.estimator == Estimator::full && !uses_features_) {
    find_by_features();
    if (features_are_believable()) starts[count++] = vehicle_by_features();
  }
  const Stopwatch watch(timings_.search);
  const PoseLattice lattice(prediction, settings_.search);
  starts[count++] = {refiner_.most_likely(input, prediction, lattice.poses(), lattice.spread(),
                                          settings_.refinement),
                     lattice.spread()};
  const double shared = shared_ratio(scan_fit_);
  std::array<ScanFit, 3> fits;
  std::array<double, 3> scores{};
  std::size_t best = 0;
  for (std::size_t i = 0; i < count; ++i) {
    fits[i] = i == 0 ? scan_fit_ : refine_from(input, starts[i]);
    scores[i] = fits[i].converged ? plausibility(fits[i], prediction, shared)
                                  : -std::numeric_limits<double>::infinity();
    if (scores[i] > scores[best]) best = i;
  }
  for (std::size_t i = 0; i < count && !rival_; ++i) {
    if (i == best || !fits[i].converged || !elsewhere(fits[i], fits[best])) continue;
    const double gap = scores[best] - scores[i];
    if (gap < settings_.status.rival_gain) add_rival(fits[i], gap);
  }
  // The refiner's beams and shares are to be those of the fit that is taken: its last one.
  scan_fit_ = best + 1 == count ? fits[best] : refine_from(input, starts[best]);
}

/// The rival stays where its own dead reckoning leaves it: the walls that it holds for wrong must
/// not draw it to the estimate.
ScanFit Localizer::refine_rival(const RefinementInput& input) {
  const PoseWithCovariance& rival = rival_->tracker.estimate();
  const PoseWithCovariance at{rival.pose, floored(rival.covariance)};
  return refiner_.refine(input, at, at, settings_.refinement);
}

/// Another pose that explains the scan about as well, from now on carried along.
void Localizer::add_rival(const ScanFit& fit, double lead) {
  rival_ = Rival{tracker_, lead, 0.0};
  rival_->tracker.update(observation_of(fit), settings_.tracking);
  ambiguous_ =
      lead < settings_.status.ambiguous_gain && explains(quality_of(fit), settings_.status);
}

/// Lets the scan decide between the pose and its rival, who both came here by dead reckoning.
/// Before the vehicle has gone some way from where they parted, one wall may speak for both scans.
void Localizer::weigh_rival(const RefinementInput& input, const ScanFit& rival_fit) {
  const StatusOptions& options = settings_.status;
  const bool stands = explains(quality_of(rival_fit), options) && elsewhere(rival_fit, scan_fit_);
  const bool as_good = quality_of(rival_fit).evidence_ratio >
                       options.rival_evidence_ratio * quality_of(scan_fit_).evidence_ratio;
  if (stands) {
    const double gain =
        shared_ratio(scan_fit_) * (scan_fit_.log_likelihood - rival_fit.log_likelihood);
    rival_->lead = std::clamp(rival_->lead + gain, -options.rival_gain, options.rival_gain);
  }
  if (!stands && reconciled()) {
    rival_.reset();
    return;
  }
  if (rival_->lead < -options.ambiguous_gain) {
    change_places(input);
    return;
  }
  if (stands) rival_->tracker.update(observation_of(rival_fit), settings_.tracking);
  if (rival_->way_m > options.rival_way_m && !(stands && as_good)) {
    rival_.reset();
    return;
  }
  ambiguous_ = stands && std::abs(rival_->lead) < options.ambiguous_gain;
}

/// Whether the rival has become so unsure that the estimate is within its reach: they are one.
bool Localizer::reconciled() const {
  const PoseWithCovariance& rival = rival_->tracker.estimate();
  const Vector3d apart = difference(rival.pose, scan_fit_.pose);
  const Matrix3d spread = rival.covariance + fix_covariance(scan_fit_.information);
  return apart.dot(spread.inverse() * apart) < settings_.status.reconciled_chi_square;
}

/// The scans speak for the rival: it becomes the estimate, and the estimate its rival; both as they
/// were before this scan.
void Localizer::change_places(const RefinementInput& input) {
  std::swap(tracker_, rival_->tracker);
  rival_->lead = -rival_->lead;
  predicted_ = tracker_.estimate();
  scan_fit_ = refine_from(input, {predicted_.pose, floored(predicted_.covariance)});
}

}  // namespace adit
