#include <gtest/gtest.h>

#include <limits>

#include "adit/scan/laser_scan.hpp"
#include "adit/scan/scanner_model.hpp"
#include "adit/scan/sweep_timing.hpp"

namespace adit {
namespace {

TEST(LaserScan, KnowsNoReturns) {
  LaserScan scan;
  scan.max_range = 80.0;
  scan.ranges = {1.0,
                 80.0,
                 81.0,
                 0.0,
                 -1.0,
                 std::numeric_limits<double>::quiet_NaN(),
                 std::numeric_limits<double>::infinity(),
                 79.99};
  const std::vector<bool> expected = {true, false, false, false, false, false, false, true};
  for (std::size_t i = 0; i < expected.size(); ++i) EXPECT_EQ(scan.has_return(i), expected[i]) << i;
}

TEST(LaserScan, ACircleClosesWhenTheNextBeamWouldBeTheFirst) {
  LaserScan scan;
  scan.ranges.assign(1000, 1.0);
  scan.bearing_step = kTwoPi / 1000;
  EXPECT_TRUE(scan.is_full_circle());
  scan.bearing_step = -scan.bearing_step;
  EXPECT_TRUE(scan.is_full_circle());
  EXPECT_EQ(scan.beams_of_one_turn(), 1000u);
  scan.ranges.push_back(1.0);  // the last beam repeats the first, as in -pi to pi inclusive
  EXPECT_TRUE(scan.is_full_circle());
  EXPECT_EQ(scan.beams_of_one_turn(), 1000u);
  scan.ranges.resize(999);
  EXPECT_FALSE(scan.is_full_circle());
  EXPECT_EQ(scan.beams_of_one_turn(), 999u);
  scan.ranges.assign(180, 1.0);
  scan.bearing_step = radians(1.0);
  EXPECT_FALSE(scan.is_full_circle());
}

TEST(LaserScan, BearingsOfItsOwnComeBeforeTheEvenFan) {
  LaserScan scan;
  scan.bearing_step = kTwoPi / 100;
  scan.ranges.assign(100, 1.0);
  EXPECT_EQ(scan.bearing(3), 3 * scan.bearing_step);
  for (int i = 0; i < 100; ++i) scan.bearings.push_back(0.1 + i * scan.bearing_step);
  EXPECT_EQ(scan.bearing(3), 0.1 + 3 * scan.bearing_step);
  EXPECT_EQ(scan.beams_of_one_turn(), 100u);
  // Spread over more than a turn, the last repeat the first.
  for (double& bearing : scan.bearings) bearing *= 1.05;
  scan.bearing_step *= 1.05;
  EXPECT_TRUE(scan.is_full_circle());
  EXPECT_EQ(scan.beams_of_one_turn(), 95u);
  for (double& bearing : scan.bearings) bearing *= -1.0;
  scan.bearing_step *= -1.0;
  EXPECT_EQ(scan.beams_of_one_turn(), 95u);
}

TEST(SweepTiming, TheStampNamesAMomentOfTheSweep) {
  ScannerModel model;
  model.sweep_s = 0.2;
  const auto times = [&](SweepMoment stamp) {
    model.stamp = stamp;
    return sweep_timing(model, 100);
  };
  EXPECT_DOUBLE_EQ(times(SweepMoment::start).at(0), 0.0);
  EXPECT_DOUBLE_EQ(times(SweepMoment::start).at(99), 0.198);
  EXPECT_DOUBLE_EQ(times(SweepMoment::middle).at(0), -0.1);
  EXPECT_NEAR(times(SweepMoment::middle).at(50), 0.0, 1e-15);
  EXPECT_DOUBLE_EQ(times(SweepMoment::end).at(0), -0.2);
  EXPECT_NEAR(times(SweepMoment::end).at(99), -0.002, 1e-15);
  model.sweep_s = 0.0;
  EXPECT_EQ(times(SweepMoment::end).at(70), 0.0);
  EXPECT_EQ(sweep_timing(model, 0).step_s, 0.0);
}

TEST(ScannerModel, RoundingAddsToTheNoise) {
  ScannerModel model;
  model.range_sigma_m = 0.1;
  model.quantisation_m = 0.1;
  EXPECT_NEAR(model.beam_sigma_m() * model.beam_sigma_m(), 0.01 + 0.01 / 12, 1e-12);
}

}  // namespace
}  // namespace adit
