// The stages of one turn of the cycle, in their order.

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "adit/localizer/localizer.hpp"
#include "adit/relocation/fit_quality.hpp"

namespace adit {

/// Forgets what the last turn found.
void Localizer::begin_turn() {
  timings_ = Timings{};
  uses_features_ = believed_ = contributed_ = ambiguous_ = false;
  model_.clear();
  match_ = MatchResult{};
  fit_ = FeatureFit{};
  scan_fit_ = ScanFit{};
  way_m_ = 0.0;
}

/// Dead reckoning from the last estimate: wheels, and the gyro's heading where there is one.
void Localizer::predict_pose(double stamp, const std::optional<Pose2>& odom_from_vehicle) {
  const Stopwatch watch(timings_.tracking);
  const LocalizerOptions& options = settings_.localizer;
  const std::optional<Pose2> gyro = gyro_.at(stamp, options.max_age_s);
  const bool has_turn = gyro && last_gyro_;
  const bool has_move = odom_from_vehicle && last_odometry_;
  Pose2 move = has_move ? inverse(*last_odometry_) * *odom_from_vehicle : Pose2{};
  OdometryNoise noise = settings_.odometry;
  if (has_turn) {
    move.theta = angle_between(*last_gyro_, gyro->theta);
    noise.rotation_sigma_rad_per_m = 0.0;
    noise.rotation_sigma_ratio = 0.0;
    noise.rotation_floor_rad = options.gyro_sigma_rad;
  }
  if (has_move || has_turn) dead_reckon_by(move, noise);
  if (!has_move) wait(has_turn);
  predicted_ = tracker_.estimate();
  // Without odometry the scan moves the pose, and what the wheels said before is of no use.
  last_odometry_ = odom_from_vehicle;
  last_gyro_ = gyro ? std::optional<double>(gyro->theta) : std::nullopt;
}

void Localizer::dead_reckon_by(const Pose2& move, const OdometryNoise& noise) {
  way_m_ = move.translation().norm();
  tracker_.predict(move, noise, settings_.tracking);
  hypotheses_.predict(move, noise, settings_.tracking);
  since_search_.predict(move, noise, settings_.tracking);
  if (!rival_) return;
  rival_->tracker.predict(move, noise, settings_.tracking);
  rival_->way_m += way_m_;
}

/// Time passes and nobody says how the vehicle moved.
void Localizer::wait(bool knows_turn) {
  const LocalizerOptions& options = settings_.localizer;
  const double seconds = jumped_ ? options.longest_unknown_s
                                 : std::min(std::abs(stamps_.step_s()), options.longest_unknown_s);
  const double metres = seconds * options.unknown_speed_m_per_s;
  const double radians = knows_turn ? 0.0 : seconds * options.unknown_turn_rate_rad_per_s;
  tracker_.blur(metres, radians);
  hypotheses_.blur(metres, radians);
  since_search_.blur(metres, radians);
  if (rival_) rival_->tracker.blur(metres, radians);
}

/// The scan as it would have been taken at its stamp, by the odometry's motion during the sweep.
void Localizer::deskew_scan(const LaserScan& scan) {
  const Stopwatch watch(timings_.deskew);
  scanner_ = settings_.scanner_of(scan);
  vehicle_from_laser_ = scan.vehicle_from_laser;
  predicted_laser_ = carry(predicted_, vehicle_from_laser_);
  motion_.reset();
  still_ = &scan;
  if (!(scanner_.sweep_s > 0.0)) return;
  const SweepMotion motion =
      sweep_motion(odometry_, scan.stamp, scanner_, settings_.odometry, settings_.motion);
  motion_ = SweepPrior{sweep_path(motion, scan), motion.covariance};
  deskewer_.deskew(scan, scanner_, motion.twist, settings_.deskew, deskewed_);
  still_ = &deskewed_;
}

/// Features find the pose when the prediction is too unsure to fit all points from there.
bool Localizer::wants_features() const {
  const LocalizerOptions& options = settings_.localizer;
  if (settings_.estimator != Estimator::full) return settings_.estimator == Estimator::features;
  if (is_anywhere_) return false;
  const Matrix3d& covariance = predicted_.covariance;
  const double metres = options.features_sigma_m;
  const double radians = options.features_sigma_rad;
  return options.features_every_scan || !clear_ || doubled_ || trust_.contradicted() ||
         covariance.topLeftCorner<2, 2>().trace() > metres * metres ||
         covariance(2, 2) > radians * radians;
}

/// The vehicle's way during the sweep as the odometry has it, or a steady motion where it has none.
SweepPath Localizer::sweep_path(const SweepMotion& motion, const LaserScan& scan) const {
  const std::size_t beams = scan.ranges.size();
  SweepPath path = steady_path(motion.twist, sweep_timing(scanner_, beams), beams);
  const double spacing = path.span_s / static_cast<double>(SweepPath::kSteps);
  const std::optional<Pose2> at_stamp = odometry_.at(scan.stamp, 0.0);
  if (!motion.known || !at_stamp ||
      !odometry_.covers(scan.stamp + path.begin_s, path.span_s, 0.25 * path.span_s)) {
    return path;
  }
  for (std::size_t k = 0; k < path.stamp_from_vehicle.size(); ++k) {
    const std::optional<Pose2> there = odometry_.at(scan.stamp + path.time(k), spacing);
    if (there) path.stamp_from_vehicle[k] = inverse(*at_stamp) * *there;
  }
  return path;
}

/// The map's features in sight of the predicted position.
void Localizer::predict_features() {
  const Stopwatch watch(timings_.prediction);
  const Vector2d observer = predicted_laser_.pose.translation();
  visibility_.sweep(map_, observer, scanner_.no_return_from(still_->max_range));
  adit::predict_features(map_, visibility_, observer, settings_.prediction, model_);
}

void Localizer::extract_features() {
  const Stopwatch watch(timings_.extraction);
  extractor_.extract(*still_, scanner_, settings_.extraction);
}

/// Model and sensed features both in the frame of the predicted laser.
void Localizer::match_features() {
  const Stopwatch watch(timings_.matching);
  transform(model_, {0.0, 0.0, -predicted_laser_.pose.theta}, model_in_laser_);
  const MatchingOptions tolerances =
      tolerances_from_prior(settings_.matching, floored(predicted_laser_.covariance));
  match_ = matcher_.match(extractor_.features(), model_in_laser_, tolerances);
}

void Localizer::estimate_pose() {
  const Stopwatch watch(timings_.estimation);
  uses_features_ = true;
  const Pose2 start{0.0, 0.0, predicted_laser_.pose.theta};
  const PoseWithCovariance prior{start, floored(predicted_laser_.covariance)};
  EstimationOptions options = settings_.estimation;
  options.map_sigma_m = uses_points() ? map_error_.error().sigma_m() : settings_.map.sigma_m;
  fit_ = estimator_.fit(extractor_.features(), model_, match_.pairs, start, options, prior);
}

/// The predicted pose counts as no surer than the floors, in any direction.
Matrix3d Localizer::floored(const Matrix3d& covariance) const {
  const LocalizerOptions& options = settings_.localizer;
  // In units of the floors, so that one eigenvalue decomposition serves metres and radians.
  const Vector3d unit(options.prior_floor_m, options.prior_floor_m, options.prior_floor_rad);
  const Vector3d inverse_unit = unit.cwiseInverse();
  const Matrix3d scaled = inverse_unit.asDiagonal() * covariance * inverse_unit.asDiagonal();
  Eigen::SelfAdjointEigenSolver<Matrix3d> eigen;
  eigen.computeDirect(scaled);
  const Vector3d values = eigen.eigenvalues().cwiseMax(1.0);
  const Matrix3d vectors = eigen.eigenvectors();
  return unit.asDiagonal() * (vectors * values.asDiagonal() * vectors.transpose()) *
         unit.asDiagonal();
}

bool Localizer::features_are_believable() const {
  const BeliefOptions& options = settings_.belief;
  if (!fit_.converged || fit_.used < options.min_pairs) return false;
  const double matched = static_cast<double>(match_.pairs.size());
  if (fit_.dropped > options.max_dropped_ratio * matched) return false;
  const Vector3d innovation(fit_.pose.x, fit_.pose.y,
                            angle_between(predicted_laser_.pose.theta, fit_.pose.theta));
  const Matrix3d expected = floored(predicted_laser_.covariance);
  const double gate =
      fit_.used < options.few_pairs ? options.few_pairs_gate_chi_square : options.gate_chi_square;
  return innovation.dot(expected.inverse() * innovation) < gate;
}

PoseWithCovariance Localizer::vehicle_by_features() const {
  const Vector2d observer = predicted_laser_.pose.translation();
  const Pose2 laser{fit_.pose.x + observer.x(), fit_.pose.y + observer.y(), fit_.pose.theta};
  return carry({laser, fit_.covariance}, inverse(vehicle_from_laser_));
}

/// The estimate, from scan and dead reckoning, if the scan explains itself there.
void Localizer::track_pose() {
  const Stopwatch watch(timings_.tracking);
  if (is_anywhere_) return;
  if (!uses_points()) {
    believed_ = contributed_ = features_are_believable();
    if (believed_) tracker_.start(vehicle_by_features());
    return;
  }
  const PoseObservation fix = observation_of(scan_fit_);
  const double gate = settings_.tracking.gate_chi_square;
  FitQuality quality = quality_of(scan_fit_);
  quality.agrees = tracker_.chi_square(fix) < gate;
  clear_ = quality.evidence_ratio > settings_.localizer.clear_evidence_ratio;
  doubled_ = scan_fit_.counts.between > settings_.localizer.doubled_ratio * scan_fit_.counts.wall;
  believed_ = trust_.next(quality, way_m_, settings_.status) && hypotheses_.empty();
  if (believed_) {
    trusted_m_ += way_m_;
    schedule_.note_success();
    if (clear_) doubts_.note_success();
  }
  // What is not trusted may still be the truth: all that explains its scan is taken in.
  const bool helps = quality.converged && quality.agrees &&
                     quality.evidence_ratio > settings_.status.used_evidence_ratio;
  contributed_ = helps || explains(quality, settings_.status);
  if (!contributed_) return;
  const PoseTracker before = tracker_;
  const double chi_square = tracker_.update(fix, settings_.tracking);
  if (chi_square > gate && !rival_) {
    rival_ = Rival{before, 0.0, 0.0};
    // One scan against all before it: the next must decide.
    ambiguous_ = chi_square > settings_.status.jump_chi_square;
  }
  if (!believed_) return;
  learn_map_error();
}

/// From the residuals of a scan that the pose explains.
void Localizer::learn_map_error() {
  if (!settings_.map.is_stated && first_map_error_.is_open()) {
    first_map_error_.add(refiner_.beams(), scanner_);
    MapErrorOptions options = settings_.map;
    options.sigma_m = first_map_error_.sigma_m();
    map_error_ = MapErrorEstimator(options);
  }
  map_error_.add(refiner_.beams(), refiner_.on_wall(), scanner_, tracker_.estimate().covariance);
}

/// What the plan errs around here, as far as features go. Scan after scan sees the same error, so
/// it is no noise that the filter may average; it stands beside what the filter believes.
Matrix3d Localizer::shared_map_error() const {
  const double metres = settings_.map.sigma_m;
  const double radians = metres / settings_.belief.map_stretch_m;
  return Vector3d(metres * metres, metres * metres, radians * radians).asDiagonal();
}

/// Says what was found, and whether to trust it.
void Localizer::judge(double stamp) {
  const Stopwatch watch(timings_.tracking);
  const Pose2& now = tracker_.estimate().pose;
  displacement_.drive(
      last_odometry_ ? way_m_ : (now.translation() - estimate_.pose.translation()).norm(),
      settings_.displacement);
  estimate_ = Estimate{};
  estimate_.stamp = stamp;
  estimate_.pose = tracker_.estimate().pose;
  estimate_.covariance = tracker_.estimate().covariance;
  if (!uses_points()) estimate_.covariance += shared_map_error();
  estimate_.dead_reckoned = !contributed_;
  if (is_anywhere_) {
    estimate_.covariance = unknown_covariance();
  } else if (!hypotheses_.empty()) {
    estimate_.covariance = hypotheses_.covariance_about(estimate_.pose);
  }
  if (!hypotheses_.empty() && contributed_) estimate_.status = Status::ambiguous;
  if (!believed_) return;
  estimate_.status = Status::ok;
  estimate_.chi_square = fit_.chi_square;
  estimate_.degrees_of_freedom = fit_.degrees_of_freedom;
  if (uses_features_ && features_are_believable()) estimate_.pairs = estimator_.pairs_used();
  if (!uses_points()) return;
  estimate_.chi_square = scan_fit_.chi_square;
  estimate_.degrees_of_freedom = static_cast<int>(scan_fit_.counts.wall) - 3;
  estimate_.open_direction =
      open_direction(fix_covariance(scan_fit_.information), settings_.status);
  if (estimate_.open_direction) estimate_.status = Status::degraded;
  if (ambiguous_) estimate_.status = Status::ambiguous;
  if (!ambiguous_) estimate_.protection_m = protection_radius();
}

/// Over the hypotheses that one wall is wrong, that a wall stands where returns are parallel to
/// it, and that the rival is right (m).
double Localizer::protection_radius() {
  walls_.clear();
  for (const WallShare& share : refiner_.shares()) {
    walls_.push_back({share.wall, share.equations.information, share.equations.score});
  }
  const PoseWithCovariance& at = tracker_.estimate();
  double level = protection_.update(at, predicted_, scan_fit_.pose, walls_, settings_.protection);
  const auto cover = [&](double apart, const Matrix3d& covariance) {
    level = std::max(level, apart + radius_of(covariance, settings_.protection.risk));
  };
  displacement_.see(largest_displacement(refiner_.beams(), refiner_.on_wall(), scanner_,
                                         map_error_.error().sigma_m(), settings_.displacement));
  const double displaced = displacement_.largest();
  if (displaced > 0.0) cover(displaced, at.covariance);
  if (rival_) {
    const PoseWithCovariance& rival = rival_->tracker.estimate();
    cover((rival.pose.translation() - at.pose.translation()).norm(), rival.covariance);
  }
  return level;
}

}  // namespace adit
