#include "adit/localizer/feature_fitter.hpp"

#include <Eigen/LU>

#include "adit/localizer/prior_floor.hpp"
#include "adit/prediction/prediction.hpp"

namespace adit {

void FeatureFitter::clear() {
  model_.clear();
  match_ = MatchResult{};
  fit_ = FeatureFit{};
}

FeatureFix FeatureFitter::fit(const Sweep& sweep, const PoseWithCovariance& predicted,
                              double map_sigma_m, Timings& timings) {
  const Pose2& vehicle_from_laser = sweep.scan.vehicle_from_laser;
  const PoseWithCovariance laser = carry(predicted, vehicle_from_laser);
  predict(sweep, laser, timings);
  extract(sweep, timings);
  match_to(laser, timings);
  estimate(laser, map_sigma_m, timings);
  if (!is_believable(laser)) return {};
  const Vector2d observer = laser.pose.translation();
  const Pose2 fitted{fit_.pose.x + observer.x(), fit_.pose.y + observer.y(), fit_.pose.theta};
  return {true, carry({fitted, fit_.covariance}, inverse(vehicle_from_laser))};
}

/// The map's features in sight of the predicted position.
void FeatureFitter::predict(const Sweep& sweep, const PoseWithCovariance& laser, Timings& timings) {
  const Stopwatch watch(timings.prediction);
  const Vector2d observer = laser.pose.translation();
  visibility_.sweep(map_, observer, sweep.scanner.no_return_from(sweep.still.max_range));
  predict_features(map_, visibility_, observer, settings_.prediction, model_);
}

void FeatureFitter::extract(const Sweep& sweep, Timings& timings) {
  const Stopwatch watch(timings.extraction);
  extractor_.extract(sweep.still, sweep.scanner, settings_.extraction);
}

/// Model and sensed features both in the frame of the predicted laser.
void FeatureFitter::match_to(const PoseWithCovariance& laser, Timings& timings) {
  const Stopwatch watch(timings.matching);
  transform(model_, {0.0, 0.0, -laser.pose.theta}, model_in_laser_);
  const MatchingOptions tolerances =
      tolerances_from_prior(settings_.matching, floored(laser.covariance, settings_.localizer));
  match_ = matcher_.match(extractor_.features(), model_in_laser_, tolerances);
}

void FeatureFitter::estimate(const PoseWithCovariance& laser, double map_sigma_m,
                             Timings& timings) {
  const Stopwatch watch(timings.estimation);
  const Pose2 start{0.0, 0.0, laser.pose.theta};
  const PoseWithCovariance prior{start, floored(laser.covariance, settings_.localizer)};
  EstimationOptions options = settings_.estimation;
  options.map_sigma_m = map_sigma_m;
  fit_ = estimator_.fit(extractor_.features(), model_, match_.pairs, start, options, prior);
}

bool FeatureFitter::is_believable(const PoseWithCovariance& laser) const {
  const BeliefOptions& options = settings_.belief;
  if (!fit_.converged || fit_.used < options.min_pairs) return false;
  const double matched = static_cast<double>(match_.pairs.size());
  if (fit_.dropped > options.max_dropped_ratio * matched) return false;
  const Vector3d innovation(fit_.pose.x, fit_.pose.y,
                            angle_between(laser.pose.theta, fit_.pose.theta));
  const Matrix3d expected = floored(laser.covariance, settings_.localizer);
  const double gate =
      fit_.used < options.few_pairs ? options.few_pairs_gate_chi_square : options.gate_chi_square;
  return innovation.dot(expected.inverse() * innovation) < gate;
}

}  // namespace adit
