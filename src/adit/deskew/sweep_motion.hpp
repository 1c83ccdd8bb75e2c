#pragma once

#include "adit/motion/pose_history.hpp"
#include "adit/motion/twist.hpp"
#include "adit/scan/scanner_model.hpp"

namespace adit {

/// What is known of a vehicle's motion without odometry, and how fast that motion changes.
struct SweepMotionOptions {
  double speed_sigma_m_per_s = 2.0;
  double turn_rate_sigma_rad_per_s = 0.5;
  double acceleration_m_per_s2 = 1.0;
  double turn_acceleration_rad_per_s2 = 0.5;
  double max_sigmas = 5.0;

  template <class Self, class Field>
  static void visit(Self& self, Field&& field) {
    field("speed_sigma_m_per_s", self.speed_sigma_m_per_s,
          "speed on each axis, one sigma, where there is no odometry (m/s); of a mine vehicle");
    field("turn_rate_sigma_rad_per_s", self.turn_rate_sigma_rad_per_s,
          "turn rate, one sigma, where there is no odometry (rad/s)");
    field("acceleration_m_per_s2", self.acceleration_m_per_s2,
          "acceleration, one sigma (m/s2): how much odometry from before or after the sweep says "
          "of the speed in it");
    field("turn_acceleration_rad_per_s2", self.turn_acceleration_rad_per_s2,
          "the same for the turn rate (rad/s2)");
    field("max_sigmas", self.max_sigmas,
          "odometry that moves faster than so many sigmas of speed or turn rate has jumped");
  }
};

/// How a vehicle moves during a sweep, as odometry has it.
struct SweepMotion {
  Twist2 twist;                            ///< of the vehicle; zero where not known
  Matrix3d covariance = Matrix3d::Zero();  ///< over (vx, vy, omega)
  bool known = false;                      ///< whether odometry says more than nothing at all
};

/// The mean motion during the sweep of a scan with this stamp, from the odometry around it.
///
/// Where the odometry ends within the sweep, as it does for a scan that is used at once, or begins
/// within it, the motion is that of the nearest span as long as the sweep, and its covariance grows
/// with the acceleration over the time that the odometry lies off. The same holds where odometry is
/// rarer than scans. A scanner that takes its scan at once has no motion to know.
SweepMotion sweep_motion(const PoseHistory& odometry, double stamp, const ScannerModel& scanner,
                         const OdometryNoise& noise, const SweepMotionOptions& options);

}  // namespace adit
