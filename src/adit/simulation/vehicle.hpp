#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "adit/motion/odometry.hpp"
#include "adit/scan/laser_scan.hpp"
#include "adit/simulation/odometry_faults.hpp"
#include "adit/simulation/scanner.hpp"
#include "adit/simulation/timed_path.hpp"
#include "adit/simulation/world.hpp"

namespace adit {

/// Odometry of the paper's run: 5 % of the distance, and 2° for each step of 1.6 m.
OdometryNoise mockup_odometry();

/// How the vehicle drives, and how its dead reckoning errs.
struct DriveOptions {
  OdometryNoise odometry = mockup_odometry();
  double speed_m_per_s = 1.0;
  double turn_rate_rad_per_s = 0.5;
  double scan_rate_hz = 5.0;
  double odometry_rate_hz = 50.0;
  double odometry_error_lead = 0.0;
  double stop_interval_s = 3.0;
  int hops = 0;
  double hop_m = 0.2;
  double hop_rad = 0.087;
  double slip_ratio = 0.0;
  double gyro_step_rad = 0.25 * kPi / 180.0;
  double gyro_sigma_rad = 0.0;
  double gyro_drift_rad_per_s = 0.0;
  double first_guess_sigma_m = 0.15;
  double first_guess_sigma_rad = 2.0 * kPi / 180.0;
  OdometryFaults faults;

  template <class Self, class Field>
  static void visit(Self& self, Field&& field) {
    OdometryNoise::visit(self.odometry, field);
    field("speed_m_per_s", self.speed_m_per_s, "speed of the drive (m/s)");
    field("turn_rate_rad_per_s", self.turn_rate_rad_per_s, "fastest turn (rad/s)");
    field("scan_rate_hz", self.scan_rate_hz, "scans a second of a drive");
    field("odometry_rate_hz", self.odometry_rate_hz,
          "odometry poses a second of a drive, beside those at the scans; 0 for none");
    field("odometry_error_lead", self.odometry_error_lead,
          "the error of a drive's odometry is steady from scan to scan, and changes so much before "
          "each, in parts of the time between them");
    field("stop_interval_s", self.stop_interval_s,
          "time from stop to stop (s); the paper's cycle time");
    field("hops", self.hops, "jumps of the machine that its odometry does not see");
    field("hop_m", self.hop_m, "size of a jump on each axis, one sigma (m)");
    field("hop_rad", self.hop_rad, "turn in a jump, one sigma (rad)");
    field("slip_ratio", self.slip_ratio,
          "share by which the wheels report more than the machine moves, beside the noise");
    field("gyro_step_rad", self.gyro_step_rad,
          "step in which the gyro reports headings (rad); the paper's 0.25 degrees");
    field("gyro_sigma_rad", self.gyro_sigma_rad, "noise of the gyro's heading (rad)");
    field("gyro_drift_rad_per_s", self.gyro_drift_rad_per_s, "drift of the gyro's heading (rad/s)");
    field("first_guess_sigma_m", self.first_guess_sigma_m,
          "how wrong the first guess is on each axis, one sigma (m)");
    field("first_guess_sigma_rad", self.first_guess_sigma_rad,
          "how wrong the heading of the first guess is, one sigma (rad)");
    OdometryFaults::visit(self.faults, field);
  }
};

/// What a vehicle brings home, and the truth. The first five lists have one entry for each scan.
struct Recording {
  std::vector<LaserScan> scans;
  std::vector<Pose2> odometry;  ///< odom_from_vehicle; begins at the first guess
  /// Whether nobody knows it at that scan; `odometry` then repeats the pose before.
  std::vector<bool> is_without_odometry;
  std::vector<StampedPose> truth;   ///< map_from_vehicle
  std::vector<double> gyro;         ///< heading (rad), quantised; only differences mean something
  std::vector<StampedPose> wheels;  ///< odom_from_vehicle at the odometry's own rate; drives only
  PoseWithCovariance first_guess;   ///< of the pose at the first scan, with the covariance it has

  /// The odometry at a scan, where there is any. A list of such flags that is empty says that all
  /// scans have it.
  std::optional<Pose2> odometry_at(std::size_t scan) const;
};

/// Stops at each pose and takes a scan there, as the paper's robot did. A hop moves the machine
/// while it stands at one of the stops after the first, from which it drives on to the next.
Recording record_stops(const World& world, std::span<const Pose2> stops, const ScannerSpec& spec,
                       const DriveOptions& options, std::uint64_t seed);

/// Drives along the poses without stopping and scans on the way, people walking about. After a hop
/// the machine steers back to its path within a few seconds.
Recording record_drive(const World& world, std::span<const Pose2> path, const ScannerSpec& spec,
                       const DriveOptions& options, std::uint64_t seed);

/// The same along a path whose times are given, with one or several scanners: `LaserScan::scanner`
/// is the index, and their sweeps begin one after the other within the time from scan to scan. The
/// first's scans and the errors of odometry do not depend on the others.
Recording record_drive(const World& world, const TimedPath& path,
                       std::span<const ScannerSpec> scanners, const DriveOptions& options,
                       std::uint64_t seed);

}  // namespace adit
