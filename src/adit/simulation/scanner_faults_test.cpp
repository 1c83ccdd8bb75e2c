#include "adit/simulation/scanner_faults.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "adit/simulation/vehicle.hpp"

namespace adit {
namespace {

/// A room without any symmetry.
World room() {
  return from_plan(outline(std::vector<Vector2d>{{-4, -3}, {9, -5}, {12, 2}, {6, 8}, {-7, 5}}));
}

ScannerSpec without_noise(ScannerSpec spec) {
  spec.model.range_sigma_m = 0.0;
  spec.model.quantisation_m = 0.0;
  return spec;
}

LaserScan scan_with(ScannerSpec spec, const ScannerFaults& faults, const Pose2& pose = {}) {
  spec.faults = faults;
  Random random(3);
  return simulate_scan(RayCaster(room().walls), pose, spec, random);
}

void expect_same_statement(const LaserScan& a, const LaserScan& b) {
  EXPECT_EQ(a.first_bearing, b.first_bearing);
  EXPECT_EQ(a.bearing_step, b.bearing_step);
  EXPECT_EQ(a.vehicle_from_laser.vector(), b.vehicle_from_laser.vector());
}

std::vector<LaserScan> drive(const ScannerFaults& faults) {
  ScannerSpec spec = sick();
  spec.faults = faults;
  const std::vector<Pose2> path = {{0, 0, 0}, {5, 0, 0}};
  return record_drive(room(), path, spec, {}, 3).scans;
}

TEST(ScannerFaults, MirroredScanIsTheOtherWayRound) {
  const ScannerSpec spec = without_noise(sick());
  const LaserScan right = scan_with(spec, {});
  LaserScan mirrored = scan_with(spec, {.is_mirrored = true});
  expect_same_statement(right, mirrored);
  EXPECT_GT(std::abs(mirrored.ranges.front() - right.ranges.front()), 0.1);
  std::reverse(mirrored.ranges.begin(), mirrored.ranges.end());
  for (std::size_t i = 0; i < right.ranges.size(); ++i) {
    EXPECT_NEAR(mirrored.ranges[i], right.ranges[i], 1e-9);
  }
}

TEST(ScannerFaults, MirroredFullCircleKeepsItsBeamAhead) {
  const ScannerSpec spec = without_noise(cyclone());
  const LaserScan right = scan_with(spec, {});
  const LaserScan mirrored = scan_with(spec, {.is_mirrored = true});
  EXPECT_NEAR(mirrored.ranges[500], right.ranges[500], 1e-9);  // bearing 0
  EXPECT_NEAR(mirrored.ranges[600], right.ranges[400], 1e-9);
}

TEST(ScannerFaults, TurnedScannerSeesWhatLiesToTheSide) {
  const ScannerSpec spec = without_noise(cyclone());
  const LaserScan right = scan_with(spec, {});
  const LaserScan turned = scan_with(spec, {.mount_yaw_rad = 25 * spec.bearing_step});
  expect_same_statement(right, turned);
  for (std::size_t i = 0; i + 25 < right.ranges.size(); ++i) {
    EXPECT_NEAR(turned.ranges[i], right.ranges[i + 25], 1e-9);
  }
}

TEST(ScannerFaults, DisplacedScannerSeesFromElsewhere) {
  ScannerSpec spec = without_noise(sick());
  spec.vehicle_from_laser = {1.0, 0.5, 0.4};
  const Pose2 vehicle{0.5, 1.0, 0.7};
  const LaserScan displaced = scan_with(spec, {.mount_x_m = 0.3, .mount_y_m = -0.2}, vehicle);
  expect_same_statement(displaced, scan_with(spec, {}, vehicle));
  const LaserScan there = scan_with(spec, {}, vehicle * Pose2{0.3, -0.2, 0.0});
  for (std::size_t i = 0; i < there.ranges.size(); ++i) {
    EXPECT_NEAR(displaced.ranges[i], there.ranges[i], 1e-9);
  }
}

TEST(ScannerFaults, BeamsThatMeetTheMachineAreShortAndTheOthersUntouched) {
  const LaserScan right = scan_with(sick(), {});
  const LaserScan body = scan_with(
      sick(),
      {.body_bearing_rad = radians(60.0), .body_width_rad = radians(10.1), .body_range_m = 0.4});
  int met = 0;
  for (std::size_t i = 0; i < right.ranges.size(); ++i) {
    const bool meets = std::abs(right.bearing(i) - radians(60.0)) <= radians(5.05);
    EXPECT_EQ(body.ranges[i], meets ? 0.4 : right.ranges[i]);
    met += meets ? 1 : 0;
  }
  EXPECT_EQ(met, 41);
}

TEST(ScannerFaults, RepeatedScansAreTheSameBits) {
  const std::vector<LaserScan> right = drive({});
  const std::vector<LaserScan> for_good = drive({.repeat_after_s = 2.0});
  const std::vector<LaserScan> for_a_while = drive({.repeat_after_s = 2.0, .repeat_s = 1.0});
  ASSERT_EQ(right.size(), for_good.size());
  const std::size_t last = 9;  // 1.8 s: the last before the scanner sticks
  for (std::size_t i = 0; i < right.size(); ++i) {
    EXPECT_EQ(for_good[i].stamp, right[i].stamp);
    EXPECT_EQ(for_good[i].ranges, right[std::min(i, last)].ranges);
    const bool sticks = i > last && right[i].stamp < 3.0 - 1e-9;
    EXPECT_EQ(for_a_while[i].ranges, right[sticks ? last : i].ranges) << i;
  }
  EXPECT_NE(right[last].ranges, right[last + 1].ranges);
}

TEST(ScannerFaults, OfTwoScannersOneFails) {
  std::vector<ScannerSpec> both = {sick(), cyclone()};
  both[1].vehicle_from_laser = {-1.0, 0.0, kPi};
  both[1].faults.repeat_after_s = 0.0;
  const TimedPath path{{{0.0, {0, 0, 0}}, {5.0, {5, 0, 0}}}};
  const Recording one = record_drive(room(), path, std::span(both).first(1), {}, 3);
  const Recording recording = record_drive(room(), path, both, {}, 3);
  std::vector<LaserScan> first;
  std::vector<LaserScan> second;
  for (std::size_t i = 0; i < recording.scans.size(); ++i) {
    const LaserScan& scan = recording.scans[i];
    if (i > 0) {
      EXPECT_GE(scan.stamp, recording.scans[i - 1].stamp);
    }
    (scan.scanner == 0 ? first : second).push_back(scan);
    EXPECT_EQ(recording.truth[i].stamp, scan.stamp);
  }
  ASSERT_EQ(first.size(), one.scans.size());
  for (std::size_t i = 0; i < first.size(); ++i) EXPECT_EQ(first[i].ranges, one.scans[i].ranges);
  ASSERT_GE(second.size(), 20u);
  EXPECT_NEAR(second[0].stamp, 0.1, 1e-9);
  EXPECT_EQ(second[0].ranges.size(), 1000u);
  EXPECT_EQ(second[0].vehicle_from_laser.x, -1.0);
  for (const LaserScan& scan : second) EXPECT_EQ(scan.ranges, second[0].ranges);
  ASSERT_EQ(recording.wheels.size(), one.wheels.size());
  for (std::size_t i = 0; i < one.wheels.size(); ++i) {
    EXPECT_EQ(recording.wheels[i].pose.vector(), one.wheels[i].pose.vector());
  }
}

}  // namespace
}  // namespace adit
