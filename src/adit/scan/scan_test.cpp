#include <gtest/gtest.h>

#include <limits>

#include "adit/scan/laser_scan.hpp"
#include "adit/scan/scanner_model.hpp"

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

TEST(ScannerModel, RoundingAddsToTheNoise) {
  ScannerModel model;
  model.range_sigma_m = 0.1;
  model.quantisation_m = 0.1;
  EXPECT_NEAR(model.beam_sigma_m() * model.beam_sigma_m(), 0.01 + 0.01 / 12, 1e-12);
}

}  // namespace
}  // namespace adit
