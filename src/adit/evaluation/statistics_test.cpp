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
  EXPECT_DOUBLE_EQ(s.median, 2.0);  // the second of four
  EXPECT_DOUBLE_EQ(s.p95, 4.0);     // 3.8, so the fourth
  EXPECT_DOUBLE_EQ(s.p99, 4.0);
  EXPECT_DOUBLE_EQ(s.max, 4.0);
}

std::vector<double> one_to(int count) {
  std::vector<double> values;
  for (int i = 1; i <= count; ++i) values.push_back(i);
  return values;
}

TEST(Statistics, OfSixteenValuesTheLargestIsThe99thPercentile) {
  const Statistics s = summarise(one_to(16));
  EXPECT_EQ(s.median, 8.0);
  EXPECT_EQ(s.p95, 16.0);  // 15.2
  EXPECT_EQ(s.p99, 16.0);  // 15.84
}

/// No more than so many of a hundred values lie above a percentile, and it is one of them.
TEST(Statistics, APercentileIsTheNearestRank) {
  const std::vector<double> hundred = one_to(100);
  for (int i = 1; i <= 100; ++i) EXPECT_EQ(percentile(hundred, 0.01 * i), i);
  EXPECT_EQ(percentile(hundred, 0.0), 1.0);
  EXPECT_EQ(percentile(hundred, 0.941), 95.0);
  EXPECT_EQ(percentile(one_to(20), 0.95), 19.0);
  EXPECT_TRUE(std::isnan(percentile({}, 0.5)));
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
