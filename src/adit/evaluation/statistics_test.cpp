#include "adit/evaluation/statistics.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace adit {
namespace {

TEST(Statistics, HandComputed) {
  const Statistics s = summarise({4.0, 1.0, 3.0, 2.0});
  EXPECT_EQ(s.count, 4);
  EXPECT_DOUBLE_EQ(s.mean, 2.5);
  EXPECT_DOUBLE_EQ(s.rms, std::sqrt(30.0 / 4.0));
  EXPECT_DOUBLE_EQ(s.median, 2.5);
  EXPECT_DOUBLE_EQ(s.p95, 3.85);  // place 2.85 between 3 and 4
  EXPECT_DOUBLE_EQ(s.p99, 3.97);
  EXPECT_DOUBLE_EQ(s.max, 4.0);
}

TEST(Statistics, OneValueIsEveryFigure) {
  const Statistics s = summarise({0.25});
  for (const double figure : {s.mean, s.rms, s.median, s.p95, s.p99, s.max}) {
    EXPECT_EQ(figure, 0.25);
  }
}

TEST(Statistics, NothingIsNotANumber) {
  const Statistics s = summarise({});
  EXPECT_EQ(s.count, 0);
  for (const double figure : {s.mean, s.rms, s.median, s.p95, s.p99, s.max}) {
    EXPECT_TRUE(std::isnan(figure));
  }
}

TEST(Statistics, AnInfiniteValueSpoilsOnlyWhatItTouches) {
  const double inf = std::numeric_limits<double>::infinity();
  const Statistics s = summarise({inf, 1.0, 2.0});
  EXPECT_EQ(s.median, 2.0);
  EXPECT_EQ(s.max, inf);
  EXPECT_EQ(s.mean, inf);
  EXPECT_EQ(s.p95, inf);
  EXPECT_EQ(summarise({inf, inf}).median, inf);
}

}  // namespace
}  // namespace adit
