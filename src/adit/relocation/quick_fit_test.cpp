#include "adit/relocation/quick_fit.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "adit/visibility/visibility.hpp"

namespace adit {
namespace {

/// A room of 14 m by 9 m with an alcove, so that it fits itself one way only.
LineMap room() {
  const std::vector<Vector2d> corners{{0.0, 0.0},  {14.0, 0.0}, {14.0, 9.0}, {8.0, 9.0},
                                      {8.0, 12.0}, {5.0, 12.0}, {5.0, 9.0},  {0.0, 9.0}};
  std::vector<Segment> walls;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    walls.push_back({corners[i], corners[(i + 1) % corners.size()]});
  }
  return LineMap::build(walls);
}

ScannerModel scanner() { return {.max_range_m = 40.0, .min_range_m = 0.1}; }

LaserScan scan_from(const LineMap& map, const Pose2& laser) {
  LaserScan scan;
  scan.first_bearing = -kPi;
  scan.bearing_step = radians(1.0);
  scan.max_range = scanner().max_range_m;
  scan.ranges.resize(360);
  Visibility visibility;
  visibility.sweep(map, laser.translation(), scan.max_range);
  visibility.ranges(laser.theta - kPi, scan.bearing_step, scan.ranges);
  return scan;
}

TEST(QuickFit, MovesAScanOntoItsWalls) {
  const LineMap map = room();
  const WallField field(map);
  const Pose2 truth{6.0, 4.0, 0.5};
  QuickFit quick_fit;
  quick_fit.set_scan(scan_from(map, truth), scanner(), 120);
  for (const Pose2& off : {Pose2{6.4, 3.8, 0.53}, Pose2{5.7, 4.3, 0.45}}) {
    const QuickFit::Result near = quick_fit.approach(field, off);
    const QuickFit::Result there = quick_fit.settle(field, near.map_from_laser);
    const Vector3d left = difference(truth, there.map_from_laser);
    EXPECT_LT(left.head<2>().norm(), 0.05);
    EXPECT_LT(std::abs(left.z()), radians(0.5));
    EXPECT_GT(there.agreement, 0.95F);
  }
}

TEST(QuickFit, RoughAgreementTellsTheRightPoseFromOthers) {
  const LineMap map = room();
  const WallField field(map);
  const Pose2 truth{6.0, 4.0, 0.5};
  QuickFit quick_fit;
  quick_fit.set_scan(scan_from(map, truth), scanner(), 40);
  const auto weights = QuickFit::off_weights(0.4F);
  const auto rough = [&](const Pose2& pose) {
    const Vector2d here = pose.translation() - field.origin();
    return quick_fit.rough_agreement(
        field,
        {static_cast<float>(here.x()), static_cast<float>(here.y()),
         static_cast<float>(std::cos(pose.theta)), static_cast<float>(std::sin(pose.theta))},
        weights);
  };
  EXPECT_GT(rough(truth), 0.45F);
  EXPECT_LT(rough({9.0, 5.0, 2.0}), 0.3F);
  EXPECT_EQ(rough({1e6, 5.0, 2.0}), 0.0F);
}

TEST(QuickFit, AgreesLessWhereTheScanWasNotTaken) {
  const LineMap map = room();
  const WallField field(map);
  QuickFit quick_fit;
  quick_fit.set_scan(scan_from(map, {6.0, 4.0, 0.5}), scanner(), 120);
  EXPECT_LT(quick_fit.settle(field, {11.0, 5.0, 2.0}).agreement, 0.8F);
}

TEST(QuickFit, SeesThroughWallsOnlyWhereTheScanWasNotTaken) {
  const LineMap map = room();
  const WallField field(map);
  QuickFit quick_fit;
  quick_fit.set_scan(scan_from(map, {6.0, 4.0, 0.5}), scanner(), 120);
  EXPECT_EQ(quick_fit.through(field, {6.0, 4.0, 0.5}), 0.0F);
  EXPECT_GT(quick_fit.through(field, {12.0, 4.0, 0.5}), 0.1F);
}

TEST(QuickFit, StaysWhereThereIsNothingToGoBy) {
  const LineMap map = room();
  const WallField field(map);
  QuickFit quick_fit;
  LaserScan blind = scan_from(map, {6.0, 4.0, 0.5});
  blind.ranges.assign(blind.ranges.size(), blind.max_range);
  quick_fit.set_scan(blind, scanner(), 120);
  const QuickFit::Result result = quick_fit.approach(field, {6.0, 4.0, 0.5});
  EXPECT_EQ(result.agreement, 0.0F);
  EXPECT_NEAR(result.map_from_laser.x, 6.0, 1e-6);
  EXPECT_NEAR(result.map_from_laser.theta, 0.5, 1e-6);
}

}  // namespace
}  // namespace adit
