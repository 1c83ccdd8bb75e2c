#pragma once

#include <gtest/gtest.h>

#include <vector>

#include "adit/recovery/testimony.hpp"
#include "adit/visibility/visibility.hpp"

namespace adit {

/// A mine, a scanner of a whole circle that sees it without noise, and the rules that scans are
/// judged by.
class RecoveryScene : public ::testing::Test {
 protected:
  explicit RecoveryScene(const std::vector<Segment>& plan) : map(LineMap::build(plan)) {
    scanner.range_sigma_m = 0.02;
    scanner.max_range_m = 40.0;
    error.offset_sigma_m = 0.02;
  }

  LaserScan scan_from(const Pose2& pose) const {
    LaserScan scan;
    scan.first_bearing = -kPi;
    scan.bearing_step = kTwoPi / 360.0;
    scan.max_range = scanner.max_range_m;
    scan.ranges.resize(360);
    Visibility visibility;
    visibility.sweep(map, pose.translation(), scan.max_range);
    visibility.ranges(pose.theta + scan.first_bearing, scan.bearing_step, scan.ranges);
    return scan;
  }

  static PoseWithCovariance near(const Pose2& pose) {
    return {pose, Vector3d(0.01, 0.01, 0.001).asDiagonal()};
  }

  LineMap map;
  ScannerModel scanner;
  MapError error;
  RefinementOptions refinement;
  TrackingOptions tracking;
  StatusOptions status;
};

}  // namespace adit
