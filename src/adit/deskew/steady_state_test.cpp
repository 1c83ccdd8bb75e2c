// Deskewing must not allocate once its buffers have grown.
#include <gtest/gtest.h>

#include "adit/deskew/deskewer.hpp"
#include "adit/deskew/sweep_motion.hpp"
#include "support/allocations.hpp"

namespace adit {
namespace {

TEST(SteadyState, DeskewingAllocatesNothing) {
  ScannerModel scanner;
  scanner.sweep_s = 0.1;
  LaserScan scan;
  scan.first_bearing = -kPi;
  scan.bearing_step = kTwoPi / 1000;
  scan.max_range = 80.0;
  scan.ranges.assign(1000, 5.0);
  PoseHistory odometry;
  for (int i = 0; i < 100; ++i) odometry.add({0.02 * i, moved({3.0, 0.0, 0.4}, 0.02 * i)});
  Deskewer deskewer;
  LaserScan out;
  const auto drive = [&] {
    for (double stamp = 0.0; stamp < 2.0; stamp += 0.1) {
      const SweepMotion motion = sweep_motion(odometry, stamp, scanner, {}, {});
      deskewer.deskew(scan, scanner, motion.twist, {}, out);
      deskewer.deskew(scan, scanner, {}, {}, out);
    }
  };
  drive();
  const long before = test::allocations();
  ASSERT_GT(before, 0);
  drive();
  EXPECT_EQ(test::allocations(), before);
}

}  // namespace
}  // namespace adit
