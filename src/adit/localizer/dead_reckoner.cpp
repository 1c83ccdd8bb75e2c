#include "adit/localizer/dead_reckoner.hpp"

#include <algorithm>
#include <cmath>

namespace adit {

void carry(const Motion& motion, const TrackingOptions& options, PoseTracker& tracker) {
  if (motion.is_reckoned) tracker.predict(motion.move, motion.noise, options);
  if (!motion.knows_way) tracker.blur(motion.unknown_m, motion.unknown_rad);
}

void DeadReckoner::reset() {
  stamps_.reset();
  odometry_.clear();
  gyro_.clear();
  last_odometry_.reset();
  last_gyro_.reset();
}

bool DeadReckoner::is_repeated(const LaserScan& scan,
                               const std::optional<Pose2>& odom_from_vehicle) {
  const StampOptions& options = settings_.stamps;
  const StampOrder order = stamps_.next(scan.stamp, scan.scanner, options);
  has_jumped_ = order == StampOrder::jump;
  if (has_jumped_) {  // what was fed before has stamps of another clock
    odometry_.keep_near(scan.stamp, options.jump_s);
    gyro_.keep_near(scan.stamp, options.jump_s);
  }
  if (order != StampOrder::duplicate || odom_from_vehicle.has_value() != last_odometry_.has_value())
    return false;
  return !odom_from_vehicle || odom_from_vehicle->vector() == last_odometry_->vector();
}

Motion DeadReckoner::since_last(double stamp, const std::optional<Pose2>& odom_from_vehicle) {
  const LocalizerOptions& options = settings_.localizer;
  const std::optional<Pose2> gyro = gyro_.at(stamp, options.max_age_s);
  const bool has_turn = gyro && last_gyro_;
  Motion motion;
  motion.has_wheels = odom_from_vehicle.has_value();
  motion.knows_way = odom_from_vehicle && last_odometry_;
  motion.is_reckoned = motion.knows_way || has_turn;
  motion.noise = settings_.odometry;
  if (motion.knows_way) motion.move = inverse(*last_odometry_) * *odom_from_vehicle;
  if (has_turn) {
    motion.move.theta = angle_between(*last_gyro_, gyro->theta);
    motion.noise.rotation_sigma_rad_per_m = 0.0;
    motion.noise.rotation_sigma_ratio = 0.0;
    motion.noise.rotation_floor_rad = options.gyro_sigma_rad;
  }
  if (!motion.knows_way) {
    const double seconds = unknown_seconds();
    motion.unknown_m = seconds * options.unknown_speed_m_per_s;
    motion.unknown_rad = has_turn ? 0.0 : seconds * options.unknown_turn_rate_rad_per_s;
  }
  // Without odometry the scan moves the pose, and what the wheels said before is of no use.
  last_odometry_ = odom_from_vehicle;
  last_gyro_ = gyro ? std::optional<double>(gyro->theta) : std::nullopt;
  return motion;
}

/// How long the vehicle may have moved without anybody saying how (s).
double DeadReckoner::unknown_seconds() const {
  const double longest = settings_.localizer.longest_unknown_s;
  return has_jumped_ ? longest : std::min(std::abs(stamps_.step_s()), longest);
}

}  // namespace adit
