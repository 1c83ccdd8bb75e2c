#include "adit/localizer/localizer.hpp"

#include <cmath>
#include <limits>
#include <utility>

namespace adit {

/// The paper's cycle, Fig. 1, with what it names as work to come: all points, and tracking.
const Estimate& Localizer::turn(const LaserScan& scan,
                                const std::optional<Pose2>& odom_from_vehicle) {
  begin_turn();
  predict_pose(scan.stamp, odom_from_vehicle);
  deskew_scan(scan);
  if (wants_features()) find_by_features();
  refine_pose(scan);
  weigh_hypotheses(scan);
  track_pose();
  seek_elsewhere(scan);
  judge(scan.stamp);
  return estimate_;
}

/// The paper's part: the pose from features, matched to those that the map promises.
void Localizer::find_by_features() {
  predict_features();
  extract_features();
  match_features();
  estimate_pose();
}

const Estimate& Localizer::update(const LaserScan& scan, const Pose2& odom_from_vehicle) {
  if (!odom_from_vehicle.is_finite() || !is_usable(scan)) return skip(scan.stamp);
  if (is_repeated(scan, odom_from_vehicle)) return estimate_;
  odometry_.add({scan.stamp, odom_from_vehicle});
  return turn(scan, odom_from_vehicle);
}

const Estimate& Localizer::update(const LaserScan& scan) {
  if (!is_usable(scan)) return skip(scan.stamp);
  const std::optional<Pose2> odometry = odometry_.at(scan.stamp, settings_.localizer.max_age_s);
  return is_repeated(scan, odometry) ? estimate_ : turn(scan, odometry);
}

/// Notes how the stamp follows the last. A scan that came twice says nothing new.
bool Localizer::is_repeated(const LaserScan& scan, const std::optional<Pose2>& odom_from_vehicle) {
  const StampOrder order = stamps_.next(scan.stamp, scan.scanner, settings_.stamps);
  if (order == StampOrder::jump) {  // what was fed before has stamps of another clock
    odometry_.keep_near(scan.stamp, settings_.stamps.jump_s);
    gyro_.keep_near(scan.stamp, settings_.stamps.jump_s);
  }
  jumped_ = order == StampOrder::jump;
  if (order != StampOrder::duplicate || odom_from_vehicle.has_value() != last_odometry_.has_value())
    return false;
  return !odom_from_vehicle || odom_from_vehicle->vector() == last_odometry_->vector();
}

bool Localizer::is_usable(const LaserScan& scan) {
  return std::isfinite(scan.stamp) && scan.vehicle_from_laser.is_finite();
}

/// Answers a scan that cannot be used from what is believed already.
const Estimate& Localizer::skip(double stamp) {
  begin_turn();
  predicted_ = tracker_.estimate();
  judge(stamp);
  return estimate_;
}

Localizer::Localizer(const LineMap& map, const LocalizerSettings& settings,
                     std::shared_ptr<const PlaceIndex> places)
    : map_(map), settings_(settings), map_error_(settings.map), finder_(map, std::move(places)) {
  start(Pose2{});
}

void Localizer::start(const Pose2& map_from_vehicle, const std::optional<Matrix3d>& covariance) {
  if (!map_from_vehicle.is_finite() || (covariance && !covariance->allFinite())) return;
  const double metres = settings_.localizer.start_sigma_m;
  const double radians = settings_.localizer.start_sigma_rad;
  const Vector3d variance(metres * metres, metres * metres, radians * radians);
  forget();
  tracker_.start({map_from_vehicle, covariance.value_or(Matrix3d(variance.asDiagonal()))});
  estimate_.pose = tracker_.estimate().pose;
  estimate_.covariance = tracker_.estimate().covariance;
}

void Localizer::start_anywhere() {
  start(Pose2{});
  is_anywhere_ = true;
  is_found_ = false;
  trusted_m_ = 0.0;
  estimate_.covariance = unknown_covariance();
}

void Localizer::forget() {
  map_error_ = MapErrorEstimator(settings_.map);
  first_map_error_.reset();
  stamps_.reset();
  odometry_.clear();
  gyro_.clear();
  last_odometry_.reset();
  last_gyro_.reset();
  trust_.reset();
  clear_ = true;
  doubled_ = false;
  rival_.reset();
  protection_.reset();
  displacement_.reset();
  finder_.wait_and_drop();
  hypotheses_.clear();
  is_anywhere_ = false;
  is_confirmed_ = false;
  trusted_m_ = std::numeric_limits<double>::infinity();  // by whoever states the start
  is_found_ = true;
  schedule_ = doubts_ = SearchSchedule{};
  estimate_ = Estimate{};
}

void Localizer::add_odometry(const StampedPose& odom_from_vehicle) {
  odometry_.add(odom_from_vehicle);
}

void Localizer::add_gyro(double stamp, double heading) { gyro_.add({stamp, {0.0, 0.0, heading}}); }

}  // namespace adit
