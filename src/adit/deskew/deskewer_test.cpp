#include "adit/deskew/deskewer.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <random>

#include "adit/geometry/segment.hpp"

namespace adit {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
const Twist2 kDrive{5.0, -0.3, radians(45.0)};
const Pose2 kMounting{1.4, -0.3, radians(25.0)};

ScannerModel perfect_scanner(SweepMoment stamp = SweepMoment::middle) {
  ScannerModel scanner;
  scanner.range_sigma_m = 0.0;
  scanner.quantisation_m = 0.0;
  scanner.sweep_s = 0.2;
  scanner.stamp = stamp;
  return scanner;
}

LaserScan fan(std::size_t beams, double first_bearing, double step) {
  LaserScan scan;
  scan.stamp = 12.0;
  scan.first_bearing = first_bearing;
  scan.bearing_step = step;
  scan.max_range = 80.0;
  scan.vehicle_from_laser = kMounting;
  scan.ranges.assign(beams, 80.0);
  return scan;
}

LaserScan full_circle(std::size_t beams = 1000) {
  return fan(beams, -kPi, kTwoPi / static_cast<double>(beams));
}

/// The laser at the time of a beam, seen from where it is at the stamp.
Pose2 stamp_from_then(const Twist2& drive, const LaserScan& scan, double seconds) {
  return inverse(scan.vehicle_from_laser) * moved(drive, seconds) * scan.vehicle_from_laser;
}

double cast(const std::vector<Segment>& walls, const Vector2d& origin, double bearing) {
  const Vector2d beam = unit_vector(bearing);
  double nearest = kInfinity;
  for (const Segment& wall : walls) {
    const Vector2d along = wall.b - wall.a;
    const double range = cross(wall.a - origin, along) / cross(beam, along);
    const double share = cross(wall.a - origin, beam) / cross(beam, along);
    if (range > 0.0 && share >= 0.0 && share <= 1.0) nearest = std::min(nearest, range);
  }
  return nearest;
}

/// The scan of walls that are given in the laser's frame at the stamp, with normal noise.
LaserScan sweep(LaserScan scan, const std::vector<Segment>& walls, const ScannerModel& scanner,
                const Twist2& drive, unsigned seed = 1) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  const SweepTiming timing = sweep_timing(scanner, scan.ranges.size());
  for (std::size_t i = 0; i < scan.ranges.size(); ++i) {
    const Pose2 laser = stamp_from_then(drive, scan, timing.at(i));
    scan.ranges[i] = cast(walls, laser.translation(), laser.theta + scan.bearing(i)) +
                     scanner.range_sigma_m * normal(random);
  }
  return scan;
}

LaserScan deskewed(const LaserScan& scan, const ScannerModel& scanner, const Twist2& drive) {
  Deskewer deskewer;
  LaserScan out;
  deskewer.deskew(scan, scanner, drive, {}, out);
  return out;
}

Vector2d point(const LaserScan& scan, std::size_t beam) {
  return scan.ranges[beam] * unit_vector(scan.bearing(beam));
}

std::size_t returns(const LaserScan& scan) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < scan.ranges.size(); ++i) count += scan.has_return(i) ? 1 : 0;
  return count;
}

class Sweeps : public testing::TestWithParam<std::tuple<SweepMoment, double>> {};

TEST_P(Sweeps, EachReturnIsCarriedByTheLasersMotionSinceItsTime) {
  const auto [stamp, direction] = GetParam();
  const ScannerModel scanner = perfect_scanner(stamp);
  LaserScan scan = fan(1081, -direction * radians(135.0), direction * radians(0.25));
  for (std::size_t i = 0; i < scan.ranges.size(); ++i) {
    scan.ranges[i] = 6.0 + std::sin(0.01 * static_cast<double>(i));
  }
  const LaserScan out = deskewed(scan, scanner, kDrive);
  const SweepTiming timing = sweep_timing(scanner, scan.ranges.size());
  ASSERT_EQ(out.bearings.size(), scan.ranges.size());
  for (std::size_t i = 0; i < scan.ranges.size(); ++i) {
    const Vector2d expected = stamp_from_then(kDrive, scan, timing.at(i)) * point(scan, i);
    ASSERT_LT((point(out, i) - expected).norm(), 1e-10) << i;
    if (i > 0) {
      ASSERT_GT(direction * (out.bearings[i] - out.bearings[i - 1]), 0.0) << i;
    }
  }
  EXPECT_DOUBLE_EQ(out.first_bearing, out.bearings.front());
  EXPECT_NEAR(out.first_bearing + 1080 * out.bearing_step, out.bearings.back(), 1e-12);
  EXPECT_EQ(out.stamp, scan.stamp);
  EXPECT_EQ(out.max_range, scan.max_range);
  EXPECT_EQ(out.vehicle_from_laser.vector(), scan.vehicle_from_laser.vector());
}

INSTANTIATE_TEST_SUITE_P(StampsAndDirections, Sweeps,
                         testing::Combine(testing::Values(SweepMoment::start, SweepMoment::middle,
                                                          SweepMoment::end),
                                          testing::Values(1.0, -1.0)));

TEST(Deskewer, WhereNothingMovesTheScanIsTheScan) {
  const ScannerModel scanner = perfect_scanner();
  ScannerModel at_once = scanner;
  at_once.sweep_s = 0.0;
  LaserScan scan = full_circle();
  std::fill(scan.ranges.begin(), scan.ranges.end(), 7.0);
  Deskewer deskewer;
  LaserScan out;
  const auto expect_untouched = [&](const ScannerModel& model, const Twist2& drive) {
    deskewer.deskew(scan, scanner, kDrive, {}, out);  // leaves its traces
    ASSERT_NE(out.ranges, scan.ranges);
    deskewer.deskew(scan, model, drive, {}, out);
    EXPECT_EQ(out.ranges, scan.ranges);
    EXPECT_TRUE(out.bearings.empty());
    EXPECT_EQ(out.first_bearing, scan.first_bearing);
    EXPECT_EQ(out.bearing_step, scan.bearing_step);
  };
  expect_untouched(at_once, kDrive);
  expect_untouched(scanner, {});
  expect_untouched(scanner, {std::nan(""), 0.0, 0.0});
  expect_untouched(scanner, {0.0, 0.0, kInfinity});
}

TEST(Deskewer, NoReturnsStaySoAndTurnWithTheVehicle) {
  const ScannerModel scanner = perfect_scanner();
  LaserScan scan = full_circle();
  const std::vector<double> none{80.0, 90.0, 0.0, -1.0, kInfinity, 0.01};
  for (std::size_t i = 0; i < scan.ranges.size(); ++i) scan.ranges[i] = none[i % none.size()];
  scan.ranges[500] = std::nan("");
  const LaserScan out = deskewed(scan, scanner, kDrive);
  const SweepTiming timing = sweep_timing(scanner, scan.ranges.size());
  for (std::size_t i = 0; i < scan.ranges.size(); ++i) {
    if (i != 500) {
      EXPECT_EQ(out.ranges[i], scan.ranges[i]);
    }
    EXPECT_NEAR(out.bearings[i], scan.bearing(i) + kDrive.omega * timing.at(i), 1e-12);
  }
  EXPECT_TRUE(std::isnan(out.ranges[500]));
}

TEST(Deskewer, NothingAtAllIsDeskewedToNothing) {
  const LaserScan out = deskewed(fan(0, 0.0, 0.01), perfect_scanner(), kDrive);
  EXPECT_TRUE(out.ranges.empty());
  EXPECT_TRUE(out.bearings.empty());
}

TEST(Deskewer, ACircleOpensOrOverlapsByTheTurn) {
  LaserScan scan = full_circle();
  std::fill(scan.ranges.begin(), scan.ranges.end(), 7.0);
  const ScannerModel scanner = perfect_scanner();
  const auto turned = [&](double degrees_per_s) {
    return deskewed(scan, scanner, {0.0, 0.0, radians(degrees_per_s)});
  };
  scan.vehicle_from_laser = {};
  // Nine degrees in a sweep are 25 beams.
  EXPECT_TRUE(turned(45.0).is_full_circle());
  EXPECT_NEAR(static_cast<double>(turned(45.0).beams_of_one_turn()), 975.0, 1.0);
  EXPECT_FALSE(turned(-45.0).is_full_circle());
  EXPECT_EQ(turned(-45.0).beams_of_one_turn(), 1000u);
  EXPECT_TRUE(turned(0.5).is_full_circle());
  EXPECT_TRUE(turned(-0.5).is_full_circle());
}

/// A wall whose end the scanner drives past, and another 7 m behind it.
std::vector<Segment> end_of_a_wall(const Vector2d& end) {
  return {{{-90.0, 10.0}, {90.0, 10.0}}, {{end.x() < 0.0 ? -30.0 : 30.0, end.y()}, end}};
}

class Edges : public testing::TestWithParam<std::tuple<double, double>> {};

TEST_P(Edges, WhatIsOutOfSightAtTheStampIsDroppedAndNothingElse) {
  const auto [speed, end_x] = GetParam();
  const std::vector<Segment> walls = end_of_a_wall({end_x, 3.0});
  const Twist2 drive{speed, 0.0, 0.0};
  // To the right it looks before the stamp, to the left after it. Driving to the right, it looks
  // behind the wall's end from where that hides less; driving to the left, from where it hides
  // more.
  LaserScan scan = fan(721, radians(10.0), radians(160.0 / 720));
  scan.vehicle_from_laser = {};
  const ScannerModel scanner = perfect_scanner();
  const LaserScan raw = sweep(scan, walls, scanner, drive);
  const LaserScan out = deskewed(raw, scanner, drive);
  std::size_t dropped = 0;
  for (std::size_t i = 0; i < out.ranges.size(); ++i) {
    const double seen = cast(walls, Vector2d::Zero(), out.bearings[i]);
    if (!out.has_return(i)) {
      EXPECT_LT(seen, raw.ranges[i] - 1.0) << i;
      ++dropped;
    } else if (std::abs(out.ranges[i] - seen) > 1e-9) {
      // The surface ends with its last return, up to a beam before the wall does.
      const double beside = out.bearings[i] + std::copysign(2.0 * scan.bearing_step, end_x);
      EXPECT_GT(cast(walls, Vector2d::Zero(), beside), 9.0) << i;
    }
  }
  EXPECT_EQ(dropped > 5, speed > 0.0) << dropped;
}

INSTANTIATE_TEST_SUITE_P(SpeedsAndEnds, Edges,
                         testing::Combine(testing::Values(-5.0, 5.0), testing::Values(-2.5, 2.5)));

TEST(Deskewer, SlowMotionDropsNothingAtEdges) {
  const std::vector<Segment> walls = end_of_a_wall({-2.0, 3.0});
  LaserScan scan = fan(721, radians(10.0), radians(160.0 / 720));
  for (const double speed : {-0.05, -1e-3, -1e-9, 1e-9, 1e-3, 0.05}) {
    const LaserScan raw = sweep(scan, walls, perfect_scanner(), {speed, 0.0, 0.0});
    EXPECT_EQ(returns(deskewed(raw, perfect_scanner(), {speed, 0.0, 0.0})), 721u) << speed;
  }
}

TEST(Deskewer, DustHidesNothing) {
  const std::vector<Segment> walls{{{-90.0, 8.0}, {90.0, 8.0}}};
  LaserScan scan =
      sweep(fan(721, radians(10.0), radians(160.0 / 720)), walls, perfect_scanner(), kDrive);
  std::mt19937_64 random(2);
  std::uniform_real_distribution<double> metres(0.5, 3.0);
  for (std::size_t i = 5; i < scan.ranges.size(); i += 10) scan.ranges[i] = metres(random);
  ASSERT_GT(returns(scan), 700u);
  EXPECT_EQ(returns(deskewed(scan, perfect_scanner(), kDrive)), returns(scan));
}

TEST(Deskewer, NoiseOfANearWallNeitherDropsNorShiftsIt) {
  const std::vector<Segment> walls{{{-200.0, 2.0}, {200.0, 2.0}}};
  ScannerModel scanner = perfect_scanner();
  scanner.range_sigma_m = 0.1;
  const LaserScan empty = fan(444, radians(10.0), radians(0.36));
  double sum = 0.0;
  double count = 0.0;
  std::size_t steps_back = 0;
  for (unsigned seed = 1; seed <= 50; ++seed) {
    const LaserScan raw = sweep(empty, walls, scanner, kDrive, seed);
    const LaserScan out = deskewed(raw, scanner, kDrive);
    ASSERT_EQ(returns(out), 444u);
    for (std::size_t i = 0; i < 444; ++i) {
      sum += point(out, i).y() - 2.0;
      count += 1.0;
      if (i > 0 && out.bearings[i] < out.bearings[i - 1]) ++steps_back;
    }
  }
  EXPECT_GT(steps_back, 100u);  // or this tests nothing
  EXPECT_NEAR(sum / count, 0.0, 3.0 * 0.1 / std::sqrt(count));
}

TEST(Deskewer, SaysWhatHasLeftItsRange) {
  LaserScan scan = fan(181, -0.5 * kPi, kPi / 180);
  std::fill(scan.ranges.begin(), scan.ranges.end(), 79.9);
  ScannerModel scanner = perfect_scanner(SweepMoment::start);
  const LaserScan out = deskewed(scan, scanner, {5.0, 0.0, 0.0});
  EXPECT_TRUE(out.has_return(0));
  EXPECT_FALSE(out.has_return(90));
}

}  // namespace
}  // namespace adit
