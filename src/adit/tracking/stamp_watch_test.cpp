#include "adit/tracking/stamp_watch.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <vector>

namespace adit {
namespace {

const StampOptions kOptions{.gap_s = 2.0, .jump_s = 60.0};

struct Step {
  double stamp;
  StampOrder order;
  double step_s;
};

void expect_steps(const std::vector<Step>& steps) {
  StampWatch watch;
  for (const Step& step : steps) {
    EXPECT_EQ(watch.next(step.stamp, 0, kOptions), step.order) << step.stamp;
    EXPECT_DOUBLE_EQ(watch.step_s(), step.step_s) << step.stamp;
  }
}

TEST(StampWatch, TellsEveryOrderApart) {
  expect_steps({{100.0, StampOrder::first, 0.0},
                {100.25, StampOrder::in_order, 0.25},
                {100.25, StampOrder::duplicate, 0.0},
                {100.0, StampOrder::late, -0.25},
                {102.5, StampOrder::gap, 2.5},
                {1e6, StampOrder::jump, 0.0},
                {1e6 + 0.5, StampOrder::in_order, 0.5},
                {100.0, StampOrder::jump, 0.0}});
}

TEST(StampWatch, LimitsBelongToTheMilderClass) {
  expect_steps({{0.0, StampOrder::first, 0.0},
                {2.0, StampOrder::in_order, 2.0},
                {4.0 + 1e-9, StampOrder::gap, 2.0 + 1e-9},
                {4.0 + 1e-9 + 60.0, StampOrder::gap, 60.0},
                {4.0 + 1e-9, StampOrder::late, -60.0},
                {-57.0, StampOrder::jump, 0.0}});
}

TEST(StampWatch, CountsWhatItMet) {
  StampWatch watch;
  for (const double stamp : {0.0, 1.0, 1.0, 1.0, 0.5, 0.0, 5.0, 9.0, 13.0, 500.0, 500.1}) {
    watch.next(stamp, 0, kOptions);
  }
  EXPECT_EQ(watch.counts().duplicates, 2);
  EXPECT_EQ(watch.counts().late, 2);
  EXPECT_EQ(watch.counts().gaps, 3);
  EXPECT_EQ(watch.counts().jumps, 1);
}

TEST(StampWatch, AStampThatIsNoNumberIsAJumpAndSoIsTheNext) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  for (const double stamp : {kNan, kInfinity, -kInfinity}) {
    expect_steps({{1.0, StampOrder::first, 0.0},
                  {stamp, StampOrder::jump, 0.0},
                  {1.1, StampOrder::jump, 0.0},
                  {1.2, StampOrder::in_order, 1.2 - 1.1}});
    expect_steps({{stamp, StampOrder::first, 0.0},
                  {stamp, StampOrder::jump, 0.0},
                  {1.0, StampOrder::jump, 0.0}});
  }
}

TEST(StampWatch, TwoScannersMayShareAStamp) {
  StampWatch watch;
  watch.next(1.0, 0, kOptions);
  EXPECT_EQ(watch.next(1.0, 1, kOptions), StampOrder::in_order);
  EXPECT_EQ(watch.next(1.2, 0, kOptions), StampOrder::in_order);
  EXPECT_EQ(watch.next(1.2, 0, kOptions), StampOrder::duplicate);
  EXPECT_EQ(watch.counts().duplicates, 1);
}

TEST(StampWatch, AResetForgets) {
  StampWatch watch;
  watch.next(1.0, 0, kOptions);
  watch.next(1.0, 0, kOptions);
  watch.reset();
  EXPECT_EQ(watch.counts().duplicates, 0);
  EXPECT_EQ(watch.next(1.0, 0, kOptions), StampOrder::first);
}

}  // namespace
}  // namespace adit
