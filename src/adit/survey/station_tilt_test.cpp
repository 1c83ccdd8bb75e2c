#include "adit/survey/station_tilt.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "adit/simulation/tilted_scanner.hpp"

namespace adit {
namespace {

struct Corridor {
  std::vector<Segment> walls{{{-40.0, 3.0}, {40.0, 3.0}}, {{-40.0, -3.0}, {40.0, -3.0}}};
  LaserScan scan;
  std::vector<double> ranges;
};

Corridor seen_with(const Tilt& tilt, const RoofAndFloor& heights) {
  Corridor corridor;
  Random random(4);
  const RayCaster caster(corridor.walls);
  const Pose2 pose{0.0, 0.0, 0.3};
  corridor.scan = simulate_tilted_scan(caster, pose, cyclone(), tilt, heights, random);
  for (std::size_t i = 0; i < corridor.scan.ranges.size(); ++i) {
    corridor.ranges.push_back(
        caster.range(pose.translation(), unit_vector(pose.theta + corridor.scan.bearing(i))));
  }
  return corridor;
}

TEST(EstimateTilt, FindsTheTiltFromWhereBeamsMeetRoofAndFloor) {
  const Tilt truth{radians(3.0), radians(-1.5)};
  const Corridor seen = seen_with(truth, {1.5, 0.9});
  TiltOptions options;
  options.roof_above_m = 1.5;
  options.floor_below_m = 0.9;
  const ScanTilt found = estimate_tilt(seen.scan, seen.ranges, options);
  // Along the corridor, where the beams meet roof and floor.
  const double along_truth = truth.pitch_rad * std::cos(0.3) + truth.roll_rad * std::sin(0.3);
  const double along_found = found.pitch_rad * std::cos(0.3) + found.roll_rad * std::sin(0.3);
  EXPECT_NEAR(along_found, along_truth, radians(0.4));
}

TEST(EstimateTilt, StaysLevelWithoutReasonToLeaveIt) {
  const Corridor seen = seen_with({}, {1.5, 0.9});
  const ScanTilt found = estimate_tilt(seen.scan, seen.ranges, {});
  EXPECT_LT(std::hypot(found.pitch_rad, found.roll_rad), radians(1.5));
}

TEST(LevelScan, LeavesOutRoofAndFloorAndKeepsWalls) {
  const Tilt truth{radians(4.0), 0.0};
  const Corridor seen = seen_with(truth, {1.5, 0.9});
  TiltOptions options;
  options.roof_above_m = 1.5;
  options.floor_below_m = 0.9;
  const LaserScan level =
      level_scan(seen.scan, seen.ranges, {truth.pitch_rad, truth.roll_rad}, options);
  int roof = 0;
  int near = 0;
  double bias = 0.0;
  for (std::size_t i = 0; i < level.ranges.size(); ++i) {
    const double wall = seen.ranges[i];
    const bool short_of_wall = seen.scan.has_return(i) && seen.scan.ranges[i] < wall - 2.0;
    roof += short_of_wall ? 1 : 0;
    EXPECT_FALSE(short_of_wall && level.has_return(i));
    if (wall < 10.0) {
      EXPECT_NEAR(level.ranges[i], wall, 0.6);  // six sigma of the scanner
      bias += level.ranges[i] - wall;
      ++near;
    }
  }
  EXPECT_GT(roof, 20);
  ASSERT_GT(near, 100);
  EXPECT_NEAR(bias / near, 0.0, 0.02);
}

TEST(RangeToRoofOrFloor, IsThatOfALevelPlane) {
  TiltOptions options;
  options.roof_above_m = 2.0;
  options.floor_below_m = 1.0;
  const ScanTilt nose_down{radians(2.0), 0.0};
  EXPECT_NEAR(range_to_roof_or_floor(0.0, nose_down, options), 1.0 / std::sin(radians(2.0)), 1e-9);
  EXPECT_NEAR(range_to_roof_or_floor(kPi, nose_down, options), 2.0 / std::sin(radians(2.0)), 1e-9);
  EXPECT_EQ(range_to_roof_or_floor(1.0, {}, options), std::numeric_limits<double>::infinity());
}

TEST(LevelScan, MakesNoReturnOfABeamThatHadNone) {
  LaserScan scan;
  scan.first_bearing = 0.0;
  scan.bearing_step = radians(1.0);
  scan.max_range = 50.0;
  scan.ranges = {50.0, 40.0, 8.0};
  ScannerModel scanner;
  scanner.max_range_m = 40.0;
  TiltOptions options;
  options.roof_above_m = options.floor_below_m = 0.0;
  const std::vector<double> walls(3, 60.0);
  const LaserScan level = level_scan(scan, walls, {radians(3.0), 0.0}, options, scanner);
  EXPECT_FALSE(level.has_return(0));
  EXPECT_FALSE(level.has_return(1));
  EXPECT_NEAR(level.ranges[2], 8.0 * std::cos(radians(3.0)), 1e-3);
}

}  // namespace
}  // namespace adit
