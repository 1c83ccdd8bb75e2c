#pragma once

#include <optional>

#include "adit/localizer/settings.hpp"
#include "adit/motion/odometry.hpp"
#include "adit/motion/pose_history.hpp"
#include "adit/scan/laser_scan.hpp"
#include "adit/tracking/pose_tracker.hpp"
#include "adit/tracking/stamp_watch.hpp"

namespace adit {

/// How the vehicle moved from one scan to the next, as wheels, gyro and clock have it.
struct Motion {
  Pose2 move;                ///< last_from_now, of the vehicle; of use where `is_reckoned`
  OdometryNoise noise;       ///< of that
  bool is_reckoned = false;  ///< by wheels, or for the turn by a gyro
  bool has_wheels = false;   ///< they know the way to this scan; the next needs this one's
  bool knows_way = false;    ///< both scans have an odometry pose
  double unknown_m = 0.0;    ///< sigma of what nobody knows, on each axis (m) ...
  double unknown_rad = 0.0;  ///< ... and of the heading (rad); both where `knows_way` is false
  double way_m() const { return is_reckoned ? move.translation().norm() : 0.0; }
};

/// Carries a filter along: what is reckoned, and what nobody knows.
void carry(const Motion& motion, const TrackingOptions& options, PoseTracker& tracker);

/// Keeps what wheels, gyro and clock said, and says how the vehicle moved from scan to scan.
class DeadReckoner {
 public:
  /// The settings must outlive it.
  explicit DeadReckoner(const LocalizerSettings& settings) : settings_(settings) {}

  /// Forgets all that was fed.
  void reset();
  void add_odometry(const StampedPose& odom_from_vehicle) { odometry_.add(odom_from_vehicle); }
  /// A heading (rad); only differences count.
  void add_gyro(double stamp, double heading) { gyro_.add({stamp, {0.0, 0.0, heading}}); }

  /// The odometry at a stamp, from what was fed near it.
  std::optional<Pose2> odometry_at(double stamp) const {
    return odometry_.at(stamp, settings_.localizer.max_age_s);
  }
  const PoseHistory& odometry() const { return odometry_; }
  const StampCounts& stamp_counts() const { return stamps_.counts(); }

  /// Notes how the stamp follows the last. A scan that came twice says nothing new: then true.
  bool is_repeated(const LaserScan& scan, const std::optional<Pose2>& odom_from_vehicle);

  /// The motion from the last scan to this one, each asked for once and in order. Wheels give the
  /// move, and the gyro, where there is one, its turn.
  Motion since_last(double stamp, const std::optional<Pose2>& odom_from_vehicle);

 private:
  double unknown_seconds() const;

  const LocalizerSettings& settings_;
  PoseHistory odometry_;
  PoseHistory gyro_;
  StampWatch stamps_;
  bool has_jumped_ = false;             // the clock, before this scan
  std::optional<Pose2> last_odometry_;  // at the last scan
  std::optional<double> last_gyro_;
};

}  // namespace adit
