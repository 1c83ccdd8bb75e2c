// Deskewing must not allocate once its buffers have grown: counted by replacing operator new.
#include <gtest/gtest.h>

#include <cstdlib>
#include <new>

#include "adit/deskew/deskewer.hpp"
#include "adit/deskew/sweep_motion.hpp"

namespace {
long allocations = 0;
}  // namespace

void* operator new(std::size_t size) {
  ++allocations;
  if (void* memory = std::malloc(size > 0 ? size : 1)) return memory;
  throw std::bad_alloc();
}
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }

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
  const long before = allocations;
  ASSERT_GT(before, 0);
  drive();
  EXPECT_EQ(allocations, before);
}

}  // namespace
}  // namespace adit
