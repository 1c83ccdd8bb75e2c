#include "adit/scan/returns.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace adit {
namespace {

TEST(Returns, LieFromTheLeastRangeToBelowTheLargest) {
  LaserScan scan;
  ScannerModel scanner;
  scanner.min_range_m = 0.5;
  scanner.max_range_m = 30.0;
  scan.max_range = 20.0;
  const ReturnLimits limits = return_limits(scan, scanner);
  for (const double range : {0.5, 0.6, 19.999}) EXPECT_TRUE(limits.is_return(range)) << range;
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  constexpr double kNotANumber = std::numeric_limits<double>::quiet_NaN();
  for (const double range : {-1.0, 0.0, 0.499, 20.0, 25.0, kInfinity, kNotANumber}) {
    EXPECT_FALSE(limits.is_return(range)) << range;
  }
}

TEST(Returns, AreAboveZeroAndWithinTheScannersReachWhateverElseIsStated) {
  LaserScan scan;
  ScannerModel scanner;
  scanner.min_range_m = -1.0;
  scanner.max_range_m = 30.0;
  for (const double stated : {0.0, 50.0}) {
    scan.max_range = stated;
    const ReturnLimits limits = return_limits(scan, scanner);
    EXPECT_TRUE(limits.is_return(29.0));
    for (const double range : {-0.5, 0.0, 30.0}) EXPECT_FALSE(limits.is_return(range)) << range;
  }
}

}  // namespace
}  // namespace adit
