#include "adit/simulation/scanner.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "adit/motion/pose_history.hpp"
#include "adit/simulation/world.hpp"

namespace adit {
namespace {

ScannerSpec noiseless(ScannerSpec spec) {
  spec.model.range_sigma_m = 0.0;
  spec.model.quantisation_m = 0.0;
  return spec;
}

/// A square room of 2 * half metres round the origin.
std::vector<Segment> room(double half) {
  const std::array<Vector2d, 4> corners{Vector2d(-half, -half), Vector2d(half, -half),
                                        Vector2d(half, half), Vector2d(-half, half)};
  return outline(corners);
}

TEST(Scanner, PresetsHaveTheFieldsOfViewOfTheirNames) {
  const auto view = [&](const ScannerSpec& spec) {
    return degrees(spec.bearing_step * (spec.beams - 1));
  };
  EXPECT_NEAR(view(cyclone()), 360.0 * 0.999, 1e-9);
  EXPECT_NEAR(view(sick()), 270.0, 1e-9);
  EXPECT_NEAR(degrees(sick().bearing_step), 0.25, 1e-9);
  EXPECT_NEAR(view(hokuyo()), 240.0, 0.33);
  EXPECT_NEAR(degrees(sick_lms().bearing_step), 1.0, 1e-9);
  Random random(1);
  EXPECT_TRUE(simulate_scan(RayCaster(room(5.0)), {}, cyclone(), random).is_full_circle());
  EXPECT_FALSE(simulate_scan(RayCaster(room(5.0)), {}, sick(), random).is_full_circle());
  EXPECT_TRUE(scanner_named("hokuyo").has_value());
  EXPECT_FALSE(scanner_named("sonar").has_value());
}

TEST(Scanner, WithoutNoiseMeasuresWhatBruteForceSays) {
  const World world = mockup();
  const RayCaster caster(world.walls);
  ScannerSpec spec = noiseless(sick());
  spec.vehicle_from_laser = {1.2, -0.3, radians(30.0)};
  Random random(1);
  for (const Pose2& pose : world.path) {
    const LaserScan scan = simulate_scan(caster, pose, spec, random);
    const Pose2 map_from_laser = pose * spec.vehicle_from_laser;
    for (std::size_t i = 0; i < scan.ranges.size(); ++i) {
      ASSERT_EQ(scan.ranges[i], cast_ray(world.walls, map_from_laser.translation(),
                                         unit_vector(map_from_laser.theta + scan.bearing(i))));
    }
  }
}

TEST(Scanner, NoiseHasTheDeclaredSpreadAndSteps) {
  const RayCaster caster(room(10.04));
  ScannerSpec spec = cyclone();
  spec.beams = 1;
  spec.first_bearing = 0.0;
  Random random(5);
  double sum = 0.0;
  double squares = 0.0;
  const int count = 50000;
  for (int i = 0; i < count; ++i) {
    const double range = simulate_scan(caster, {}, spec, random).ranges[0];
    ASSERT_NEAR(range, 0.1 * std::round(range / 0.1), 1e-9);
    sum += range - 10.04;
    squares += (range - 10.04) * (range - 10.04);
  }
  EXPECT_NEAR(sum / count, 0.0, 0.002);
  EXPECT_NEAR(std::sqrt(squares / count), spec.model.beam_sigma_m(), 0.0015);
}

TEST(Scanner, BearingNoiseTurnsTheBeams) {
  const RayCaster caster(room(10.0));
  ScannerSpec spec = noiseless(cyclone());
  spec.beams = 1;
  spec.first_bearing = radians(30.0);
  spec.model.bearing_sigma_rad = 0.002;
  Random random(5);
  double squares = 0.0;
  const int count = 20000;
  const double range = 10.0 / std::cos(radians(30.0));
  for (int i = 0; i < count; ++i) {
    const double error = simulate_scan(caster, {}, spec, random).ranges[0] - range;
    squares += error * error;
  }
  // A wall met at an angle turns bearing noise into range noise: r tan(incidence) sigma.
  EXPECT_NEAR(std::sqrt(squares / count), range * std::tan(radians(30.0)) * 0.002, 3e-4);
}

TEST(Scanner, NothingWithinRangeIsNoReturn) {
  Random random(1);
  const LaserScan nothing = simulate_scan(RayCaster(), {}, cyclone(), random);
  const LaserScan too_far = simulate_scan(RayCaster(room(60.0)), {}, cyclone(), random);
  const LaserScan too_near = simulate_scan(RayCaster(room(0.01)), {}, noiseless(sick()), random);
  for (std::size_t i = 0; i < nothing.ranges.size(); ++i) {
    EXPECT_FALSE(nothing.has_return(i));
    EXPECT_FALSE(too_far.has_return(i));
    EXPECT_FALSE(too_near.has_return(i));
  }
}

TEST(Scanner, DustAndDropOutsStrikeTheirShare) {
  ScannerSpec spec = noiseless(cyclone());
  spec.beams = 20000;
  spec.bearing_step = kTwoPi / spec.beams;
  spec.dust_ratio = 0.1;
  spec.dropout_ratio = 0.05;
  Random random(2);
  const LaserScan scan = simulate_scan(RayCaster(room(20.0)), {}, spec, random);
  int missing = 0;
  int early = 0;
  for (std::size_t i = 0; i < scan.ranges.size(); ++i) {
    if (!scan.has_return(i)) ++missing;
    if (scan.has_return(i) && scan.ranges[i] < 19.9) ++early;
  }
  const double too_near = 0.1 * (1.0 - std::exp(-spec.model.min_range_m / spec.dust_range_m));
  EXPECT_NEAR(missing / 20000.0, 0.05 + too_near, 0.006);
  EXPECT_NEAR(early / 20000.0, 0.095, 0.008);
}

TEST(Scanner, SeesWhatMoves) {
  Random random(1);
  const std::vector<Segment> body = room(1.0);
  const LaserScan scan =
      simulate_scan(RayCaster(room(10.0)), {}, noiseless(cyclone()), random, body);
  EXPECT_NEAR(scan.ranges[500], 1.0, 1e-9);
}

class Sweep : public ::testing::TestWithParam<SweepMoment> {};

TEST_P(Sweep, TakesEachBeamFromWhereTheVehicleIsThen) {
  const World world = mockup();
  const RayCaster caster(world.walls);
  const Pose2 from{3.6, 6.0, radians(80.0)};
  const Pose2 to{3.2, 8.0, radians(110.0)};
  const TimedPath path{{{10.0, from}, {11.0, to}}};
  ScannerSpec spec = noiseless(cyclone());
  spec.model.sweep_s = 0.2;
  spec.model.stamp = GetParam();
  spec.vehicle_from_laser = {0.5, 0.1, 0.2};
  Random random(1);
  const LaserScan scan = simulate_sweep(caster, path, 10.5, spec, random);
  const double first = spec.model.stamp == SweepMoment::start    ? 10.5
                       : spec.model.stamp == SweepMoment::middle ? 10.4
                                                                 : 10.3;
  for (std::size_t i = 0; i < scan.ranges.size(); ++i) {
    const double t = first + 0.2 * static_cast<double>(i) / 1000.0;
    const Pose2 laser = interpolate(from, to, t - 10.0) * spec.vehicle_from_laser;
    ASSERT_NEAR(
        scan.ranges[i],
        cast_ray(world.walls, laser.translation(), unit_vector(laser.theta + scan.bearing(i))),
        1e-9);
  }
}

INSTANTIATE_TEST_SUITE_P(Stamps, Sweep,
                         ::testing::Values(SweepMoment::start, SweepMoment::middle,
                                           SweepMoment::end));

TEST(TimedPath, DrivesAsFastAsSpeedAndTurnRateAllow) {
  const std::vector<Pose2> poses{
      {0.0, 0.0, 0.0}, {2.0, 0.0, 0.0}, {2.0, 0.0, 0.0}, {2.0, 0.0, 1.0}};
  const TimedPath path = drive_along(poses, 2.0, 0.25);
  ASSERT_EQ(path.knots.size(), 3u);
  EXPECT_DOUBLE_EQ(path.knots[1].stamp, 1.0);
  EXPECT_DOUBLE_EQ(path.end(), 5.0);
  EXPECT_DOUBLE_EQ(path.at(0.25).x, 0.5);
  EXPECT_DOUBLE_EQ(path.at(3.0).theta, 0.5);
  EXPECT_DOUBLE_EQ(path.at(-1.0).x, 0.0);
  EXPECT_DOUBLE_EQ(path.at(9.0).theta, 1.0);
}

}  // namespace
}  // namespace adit
