#include "adit/localizer/localizer.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>

namespace adit {

/// The paper's cycle, Fig. 1.
const Estimate& Localizer::turn(const LaserScan& scan,
                                const std::optional<Pose2>& odom_from_vehicle) {
  predict_pose(scan.stamp, odom_from_vehicle);
  predict_features(scan);
  extract_features(scan);
  match_features();
  estimate_pose();
  judge(scan.stamp);
  return estimate_;
}

const Estimate& Localizer::update(const LaserScan& scan, const Pose2& odom_from_vehicle) {
  const bool usable = odom_from_vehicle.is_finite() && scan.vehicle_from_laser.is_finite();
  return usable ? turn(scan, odom_from_vehicle) : skip(scan.stamp);
}

const Estimate& Localizer::update(const LaserScan& scan) {
  const std::optional<Pose2> odometry = odometry_.at(scan.stamp, settings_.localizer.max_age_s);
  return scan.vehicle_from_laser.is_finite() ? turn(scan, odometry) : skip(scan.stamp);
}

/// Answers a scan that cannot be used from what is believed already.
const Estimate& Localizer::skip(double stamp) {
  predicted_ = last_;
  match_ = MatchResult{};
  fit_ = FeatureFit{};
  timings_ = Timings{};
  judge(stamp);
  return estimate_;
}

Localizer::Localizer(const LineMap& map, const LocalizerSettings& settings)
    : map_(map), settings_(settings) {
  start(Pose2{});
}

void Localizer::start(const Pose2& map_from_vehicle, const std::optional<Matrix3d>& covariance) {
  const double metres = settings_.localizer.start_sigma_m;
  const double radians = settings_.localizer.start_sigma_rad;
  const Vector3d variance(metres * metres, metres * metres, radians * radians);
  last_.pose = map_from_vehicle;
  last_.covariance = covariance.value_or(Matrix3d(variance.asDiagonal()));
  last_odometry_.reset();
  last_gyro_.reset();
}

void Localizer::add_odometry(const StampedPose& odom_from_vehicle) {
  odometry_.add(odom_from_vehicle);
}

void Localizer::add_gyro(double stamp, double heading) { gyro_.add({stamp, {0.0, 0.0, heading}}); }

/// Dead reckoning from the last estimate: wheels, and the gyro's heading where there is one.
void Localizer::predict_pose(double stamp, const std::optional<Pose2>& odom_from_vehicle) {
  const std::optional<Pose2> gyro = gyro_.at(stamp, settings_.localizer.max_age_s);
  const bool has_turn = gyro && last_gyro_;
  predicted_ = last_;
  if (last_odometry_) {
    Pose2 move = odom_from_vehicle ? inverse(*last_odometry_) * *odom_from_vehicle : Pose2{};
    OdometryNoise noise = settings_.odometry;
    if (has_turn) {
      move.theta = angle_between(*last_gyro_, gyro->theta);
      noise.rotation_sigma_rad_per_m = 0.0;
      noise.rotation_sigma_ratio = 0.0;
      noise.rotation_floor_rad = settings_.localizer.gyro_sigma_rad;
    }
    predicted_ = dead_reckon(last_, move, noise);
  }
  if (odom_from_vehicle) last_odometry_ = odom_from_vehicle;
  last_gyro_ = gyro ? std::optional<double>(gyro->theta) : std::nullopt;
}

/// The map's features in sight of the predicted position.
void Localizer::predict_features(const LaserScan& scan) {
  const Stopwatch watch(timings_.prediction);
  vehicle_from_laser_ = scan.vehicle_from_laser;
  predicted_laser_ = carry(predicted_, vehicle_from_laser_);
  const Vector2d observer = predicted_laser_.pose.translation();
  const double range = settings_.scanner.no_return_from(scan.max_range);
  visibility_.sweep(map_, observer, range);
  adit::predict_features(map_, visibility_, observer, settings_.prediction, model_);
}

void Localizer::extract_features(const LaserScan& scan) {
  const Stopwatch watch(timings_.extraction);
  extractor_.extract(scan, settings_.scanner, settings_.extraction);
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
  const Pose2 start{0.0, 0.0, predicted_laser_.pose.theta};
  const PoseWithCovariance prior{start, floored(predicted_laser_.covariance)};
  fit_ = estimator_.fit(extractor_.features(), model_, match_.pairs, start, settings_.estimation,
                        prior);
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

/// What the plan errs around here. Scan after scan sees the same error, so it is no noise that the
/// filter may average; it stands beside what the filter believes.
Matrix3d Localizer::shared_map_error() const {
  const double metres = settings_.estimation.map_sigma_m;
  const double radians = metres / settings_.localizer.map_stretch_m;
  return Vector3d(metres * metres, metres * metres, radians * radians).asDiagonal();
}

bool Localizer::is_believable() const {
  const LocalizerOptions& options = settings_.localizer;
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

/// Believes the fit or falls back on dead reckoning, and says which.
void Localizer::judge(double stamp) {
  const bool believed = is_believable();
  if (believed) {
    const Vector2d observer = predicted_laser_.pose.translation();
    const Pose2 laser{fit_.pose.x + observer.x(), fit_.pose.y + observer.y(), fit_.pose.theta};
    last_ = carry({laser, fit_.covariance}, inverse(vehicle_from_laser_));
  } else {
    last_ = predicted_;
  }
  estimate_ = Estimate{};
  estimate_.stamp = stamp;
  estimate_.pose = last_.pose;
  estimate_.covariance = last_.covariance + shared_map_error();
  estimate_.status = believed ? Status::ok : Status::lost;
  estimate_.dead_reckoned = !believed;
  if (!believed) return;
  estimate_.chi_square = fit_.chi_square;
  estimate_.degrees_of_freedom = fit_.degrees_of_freedom;
  estimate_.pairs = estimator_.pairs_used();
}

}  // namespace adit
