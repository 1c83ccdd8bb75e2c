#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "adit/localizer/localizer.hpp"
#include "support/casting.hpp"

namespace adit::testing {

inline constexpr double kMaxRange = 30.0;

/// A room that looks different from everywhere.
inline std::vector<Segment> room() {
  const std::vector<Vector2d> corners = {{0, 0}, {10, 0}, {10, 6}, {7, 6},
                                         {7, 9}, {3, 9},  {3, 7},  {0, 7}};
  std::vector<Segment> walls;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    walls.push_back({corners[i], corners[(i + 1) % corners.size()]});
  }
  return walls;
}

inline LocalizerSettings settings() {
  LocalizerSettings s;
  s.scanner.range_sigma_m = 0.005;
  s.scanner.quantisation_m = 0.01;
  s.scanner.max_range_m = kMaxRange;
  s.map.sigma_m = 0.0;
  return s;
}

/// 720 beams in steps of 1 cm; the rounding is the only noise.
inline LaserScan scan_from(const LineMap& map, const Pose2& vehicle, double stamp,
                           const Pose2& mounting = {}) {
  LaserScan scan;
  scan.stamp = stamp;
  scan.first_bearing = -kPi;
  scan.bearing_step = kTwoPi / 720;
  scan.max_range = kMaxRange;
  scan.vehicle_from_laser = mounting;
  const Pose2 laser = vehicle * mounting;
  for (std::size_t beam = 0; beam < 720; ++beam) {
    const double range =
        cast(map, laser.translation(), laser.theta + scan.bearing(beam), kMaxRange);
    scan.ranges.push_back(std::isfinite(range) ? 0.01 * std::round(100.0 * range) : kMaxRange);
  }
  return scan;
}

inline LaserScan blind_scan(double stamp) {
  LaserScan scan;
  scan.stamp = stamp;
  scan.first_bearing = -kPi;
  scan.bearing_step = kTwoPi / 720;
  scan.max_range = kMaxRange;
  scan.ranges.assign(720, kMaxRange);
  return scan;
}

/// A drive through the room, what the wheels make of it (5 % too long, and turned on the way), and
/// the scans of a laser mounted somewhere.
struct Drive {
  std::vector<Pose2> truth;
  std::vector<Pose2> odometry;
  std::vector<LaserScan> scans;
};

inline Drive drive_through(const LineMap& map, const Pose2& mounting = {}) {
  Drive drive;
  Pose2 odometry{};
  for (int i = 0; i < 14; ++i) {
    const double t = 0.4 * i;
    const Pose2 pose{2.0 + t, 2.5 + std::sin(0.8 * t), std::atan(0.8 * std::cos(0.8 * t))};
    if (!drive.truth.empty()) {
      Pose2 move = inverse(drive.truth.back()) * pose;
      move.x *= 1.05;
      move.theta += 0.004;
      odometry = odometry * move;
    }
    drive.truth.push_back(pose);
    drive.odometry.push_back(odometry);
    drive.scans.push_back(scan_from(map, pose, 100.0 + i, mounting));
  }
  return drive;
}

inline Pose2 rough_guess(const Pose2& truth) {
  return {truth.x + 0.15, truth.y - 0.1, truth.theta + 0.03};
}

inline double position_error(const Pose2& a, const Pose2& b) {
  return (a.translation() - b.translation()).norm();
}

inline void expect_near(const Pose2& a, const Pose2& b, double tolerance) {
  EXPECT_NEAR(a.x, b.x, tolerance);
  EXPECT_NEAR(a.y, b.y, tolerance);
  EXPECT_NEAR(angle_between(a.theta, b.theta), 0.0, tolerance);
}

/// A vehicle that drives through the room.
class RoomDrive : public ::testing::Test {
 protected:
  std::vector<Estimate> run(const Drive& along, const LocalizerSettings& with = settings()) {
    Localizer localizer(map, with);
    localizer.start(rough_guess(along.truth.front()));
    std::vector<Estimate> estimates;
    for (std::size_t i = 0; i < along.scans.size(); ++i) {
      estimates.push_back(localizer.update(along.scans[i], along.odometry[i]));
      estimates.back().pairs = {};  // a view of buffers that go with the localizer
    }
    return estimates;
  }
  const LineMap map = LineMap::build(room());
  const Drive drive = drive_through(map);
};

}  // namespace adit::testing
