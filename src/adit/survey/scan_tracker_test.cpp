#include "adit/survey/scan_tracker.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "adit/simulation/ray_caster.hpp"
#include "adit/simulation/scanner.hpp"

namespace adit {
namespace {

LaserScan scan_from(const Pose2& pose, const RayCaster& caster, const ScannerSpec& scanner,
                    Random& random) {
  LaserScan scan;
  scan.first_bearing = scanner.first_bearing;
  scan.bearing_step = scanner.bearing_step;
  scan.max_range = scanner.model.max_range_m;
  for (int i = 0; i < scanner.beams; ++i) {
    const double bearing = pose.theta + scanner.first_bearing + i * scanner.bearing_step;
    scan.ranges.push_back(
        reported_range(caster.range(pose.translation(), unit_vector(bearing)), scanner, random));
  }
  return scan;
}

const std::vector<Segment> kHall = {{{0, 0}, {14, 0}}, {{14, 0}, {14, 6}}, {{14, 6}, {9, 6}},
                                    {{9, 6}, {9, 8}},  {{9, 8}, {7, 8}},   {{7, 8}, {7, 6}},
                                    {{7, 6}, {0, 6}},  {{0, 6}, {0, 0}}};

/// Poses along a hall, a step of 0.1 m and a little turn each.
std::vector<Pose2> way() {
  std::vector<Pose2> poses;
  for (int i = 0; i < 100; ++i) {
    poses.push_back({2.0 + 0.1 * i, 2.5 + 0.5 * std::sin(0.1 * i), 0.4 * std::cos(0.1 * i)});
  }
  return poses;
}

TEST(ScanTracker, FollowsADriveThatDeadReckoningLoses) {
  const ScannerSpec scanner = sick_lms();
  const RayCaster caster(kHall);
  Random random(4);
  ScanTracker tracker({}, {}, {}, {});
  const std::vector<Pose2> truth = way();
  Pose2 odometry;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    if (i > 0) {
      Pose2 move = inverse(truth[i - 1]) * truth[i];
      move.x *= 1.1;
      move.theta += 0.006;
      odometry = odometry * move;
    }
    tracker.add(scan_from(truth[i], caster, scanner, random), scanner.model, odometry);
  }
  const Pose2 whole = inverse(truth.front()) * truth.back();
  ASSERT_GT(difference(whole, odometry).head<2>().norm(), 1.0);
  ASSERT_EQ(tracker.scans().size(), truth.size());
  const TrackedScan& last = tracker.scans().back();
  const Pose2 found = tracker.keyframes()[last.keyframe].pose * last.keyframe_from_scan;
  EXPECT_LT(difference(whole, found).head<2>().norm(), 0.06);
  EXPECT_GT(tracker.keyframes().size(), 20U);
  EXPECT_LT(tracker.keyframes().size(), 50U);
}

/// A hall is seen whole; then, from the same place, nothing but a corner like one of its own, a
/// pace away from it.
TEST(ScanTracker, AFewPointsDoNotOverruleDeadReckoning) {
  const ScannerSpec scanner = sick_lms();
  const RayCaster hall(kHall);
  Random random(5);
  ScanTracker tracker({}, {}, {}, {});
  const Pose2 place{7.5, 2.5, 0.3};
  tracker.add(scan_from(place, hall, scanner, random), scanner.model, {});
  const Vector2d off(-0.45, 0.4);
  LaserScan corner;
  corner.first_bearing = scanner.first_bearing;
  corner.bearing_step = scanner.bearing_step;
  corner.max_range = scanner.model.max_range_m;
  const LaserScan whole =
      scan_from(Pose2{place.x + off.x(), place.y + off.y(), place.theta}, hall, scanner, random);
  for (std::size_t i = 0; i < whole.ranges.size(); ++i) {
    const Vector2d end =
        off + place.translation() + whole.ranges[i] * unit_vector(place.theta + whole.bearing(i));
    const bool is_corner = (end - Vector2d(14.0, 6.0)).norm() < 2.5;
    corner.ranges.push_back(is_corner ? whole.ranges[i] : whole.max_range);
  }
  ASSERT_GT(std::count_if(corner.ranges.begin(), corner.ranges.end(),
                          [&](double range) { return range < corner.max_range; }),
            18);
  tracker.add(corner, scanner.model, {0.05, 0.0, 0.0});
  const TrackedScan& last = tracker.scans().back();
  const Pose2 found = tracker.keyframes()[last.keyframe].pose * last.keyframe_from_scan;
  EXPECT_LT(difference({0.05, 0.0, 0.0}, found).norm(), 0.1);
}

TEST(ScanTracker, GoesWithDeadReckoningWhereNothingIsSeen) {
  const ScannerSpec scanner = sick_lms();
  LaserScan blind;
  blind.first_bearing = scanner.first_bearing;
  blind.bearing_step = scanner.bearing_step;
  blind.max_range = scanner.model.max_range_m;
  blind.ranges.assign(static_cast<std::size_t>(scanner.beams), blind.max_range);
  ScanTracker tracker({}, {}, {}, {});
  for (int i = 0; i < 20; ++i) tracker.add(blind, scanner.model, {0.1 * i, 0.0, 0.0});
  const TrackedScan& last = tracker.scans().back();
  const Pose2 found = tracker.keyframes()[last.keyframe].pose * last.keyframe_from_scan;
  EXPECT_NEAR(found.x, 1.9, 1e-9);
  EXPECT_NEAR(found.theta, 0.0, 1e-9);
  EXPECT_EQ(tracker.keyframes().back().tracked_information.norm(), 0.0);
}

}  // namespace
}  // namespace adit
