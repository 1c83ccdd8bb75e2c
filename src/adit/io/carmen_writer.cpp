#include <fmt/compile.h>
#include <fmt/format.h>

#include <cmath>
#include <iterator>
#include <limits>

#include "adit/io/atomic_file.hpp"
#include "adit/io/carmen.hpp"

namespace adit {
namespace {

constexpr const char* kHeader =
    "# message_name [message contents] ipc_timestamp ipc_hostname logger_timestamp\n"
    "# ROBOTLASER1 laser_type start_angle field_of_view angular_resolution maximum_range accuracy "
    "remission_mode num_readings [readings] num_remissions [remissions] laser_pose_x laser_pose_y "
    "laser_pose_theta robot_pose_x robot_pose_y robot_pose_theta laser_tv laser_rv "
    "forward_safety_dist side_safety_dist turn_axis\n"
    "# ODOM x y theta tv rv accel\n"
    "# TRUEPOS true_x true_y true_theta odom_x odom_y odom_theta\n";

int message_number(const LaserId& laser) {
  if (laser.kind == LaserKind::robotlaser) return laser.number;
  return laser.kind == LaserKind::flaser ? 1 : 2;
}

void append_stamp(std::string& out, double stamp) {
  fmt::format_to(std::back_inserter(out), FMT_COMPILE(" {} adit {}\n"), stamp, stamp);
}

void append_pose(std::string& out, const Pose2& pose) {
  fmt::format_to(std::back_inserter(out), FMT_COMPILE(" {} {} {}"), pose.x, pose.y, pose.theta);
}

void append_scan(std::string& out, const LogScan& entry) {
  const LaserScan& scan = entry.scan;
  const auto steps = static_cast<double>(scan.ranges.size()) - (scan.is_full_circle() ? 0.0 : 1.0);
  fmt::format_to(std::back_inserter(out), "ROBOTLASER{} 0 {} {} {} {} {} 0 {}",
                 message_number(entry.laser), scan.first_bearing,
                 std::abs(scan.bearing_step) * steps, scan.bearing_step, scan.max_range,
                 entry.accuracy_m, scan.ranges.size());
  for (const double range : scan.ranges)
    fmt::format_to(std::back_inserter(out), FMT_COMPILE(" {}"),
                   std::isfinite(range) ? range : scan.max_range);
  out += " 0";
  append_pose(out, entry.odom_from_vehicle * scan.vehicle_from_laser);
  append_pose(out, entry.odom_from_vehicle);
  out += " 0 0 0 0 0";
  append_stamp(out, scan.stamp);
}

void append_odometry(std::string& out, const StampedPose& odometry) {
  out += "ODOM";
  append_pose(out, odometry.pose);
  out += " 0 0 0";
  append_stamp(out, odometry.stamp);
}

/// The odometry columns of TRUEPOS repeat the odometry last written.
void append_truth(std::string& out, const StampedPose& truth, const Pose2& odom_from_vehicle) {
  out += "TRUEPOS";
  append_pose(out, truth.pose);
  append_pose(out, odom_from_vehicle);
  append_stamp(out, truth.stamp);
}

}  // namespace

std::string format_carmen(const Log& log) {
  std::string out = kHeader;
  std::size_t odometry = 0;
  std::size_t truth = 0;
  Pose2 last;
  const auto write_until = [&](double stamp) {
    for (; odometry < log.odometry.size() && log.odometry[odometry].stamp <= stamp; ++odometry) {
      last = log.odometry[odometry].pose;
      append_odometry(out, log.odometry[odometry]);
    }
    for (; truth < log.true_poses.size() && log.true_poses[truth].stamp <= stamp; ++truth)
      append_truth(out, log.true_poses[truth], last);
  };
  for (const LogScan& scan : log.scans) {
    write_until(scan.scan.stamp);
    append_scan(out, scan);
    last = scan.odom_from_vehicle;
  }
  write_until(std::numeric_limits<double>::infinity());
  return out;
}

Result<void> write_carmen(const Log& log, const std::string& path) {
  for (const LogScan& scan : log.scans)
    if (!std::isfinite(scan.scan.max_range) || !std::isfinite(scan.scan.stamp) ||
        !scan.odom_from_vehicle.is_finite())
      return fail("a scan with a stamp, pose or maximum range that is not finite", path);
  return write_file(path, format_carmen(log));
}

}  // namespace adit
