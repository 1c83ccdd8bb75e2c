#include "statistics.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace adit {
namespace {

// Tables of the exact binomial bounds, and what follows in closed form where nothing or all came
// true: 1 - (alpha / 2)^(1 / n).
TEST(ClopperPearson, AgreesWithKnownBounds) {
  const Share one_of_ten = clopper_pearson(1, 10);
  EXPECT_NEAR(one_of_ten.low, 0.002529, 1e-6);
  EXPECT_NEAR(one_of_ten.high, 0.445016, 1e-6);
  const Share half = clopper_pearson(5, 10);
  EXPECT_NEAR(half.low, 0.187086, 1e-6);
  EXPECT_NEAR(half.high, 0.812914, 1e-6);
  for (const int n : {1, 30, 600, 100000}) {
    const Share none = clopper_pearson(0, n);
    EXPECT_EQ(none.low, 0.0);
    EXPECT_NEAR(none.high, 1.0 - std::pow(0.025, 1.0 / n), 1e-12);
    const Share all = clopper_pearson(n, n);
    EXPECT_NEAR(all.low, std::pow(0.025, 1.0 / n), 1e-12);
    EXPECT_EQ(all.high, 1.0);
  }
}

// By its definition: at the lower bound as many or more come true in 2.5 % of the samples, at the
// upper bound as few or fewer.
TEST(ClopperPearson, LeavesTheTailsOfTheBinomial) {
  const auto at_most = [](int k, int n, double p) {
    double sum = 0.0;
    for (int i = 0; i <= k; ++i) {
      sum += std::exp(std::lgamma(n + 1.0) - std::lgamma(i + 1.0) - std::lgamma(n - i + 1.0) +
                      i * std::log(p) + (n - i) * std::log1p(-p));
    }
    return sum;
  };
  const Share bounds = clopper_pearson(7, 952);
  EXPECT_NEAR(at_most(7, 952, bounds.high), 0.025, 1e-9);
  EXPECT_NEAR(1.0 - at_most(6, 952, bounds.low), 0.025, 1e-9);
}

TEST(ClopperPearson, KnowsNothingWithoutTrials) {
  EXPECT_EQ(clopper_pearson(0, 0).low, 0.0);
  EXPECT_EQ(clopper_pearson(0, 0).high, 1.0);
}

TEST(Histogram, FindsQuantilesToItsBins) {
  Histogram histogram;
  for (int i = 1; i <= 1000; ++i) histogram.add(0.001 * i);
  EXPECT_EQ(histogram.count(), 1000);
  EXPECT_NEAR(histogram.quantile(0.5), 0.5, 0.5 * 0.05);
  EXPECT_NEAR(histogram.quantile(0.95), 0.95, 0.95 * 0.05);
  EXPECT_NEAR(static_cast<double>(histogram.above(0.5)), 500.0, 30.0);
}

TEST(Histogram, CountsInfinityAndZero) {
  Histogram histogram;
  for (int i = 0; i < 6; ++i) histogram.add(0.0);
  for (int i = 0; i < 4; ++i) histogram.add(std::numeric_limits<double>::infinity());
  EXPECT_EQ(histogram.quantile(0.5), 0.0);
  EXPECT_TRUE(std::isinf(histogram.quantile(0.95)));
  EXPECT_EQ(histogram.above(10.0), 4);
  EXPECT_TRUE(std::isnan(Histogram().quantile(0.5)));
}

TEST(Histogram, ComesBackFromItsText) {
  Histogram histogram;
  EXPECT_EQ(Histogram::parse(histogram.text()), histogram);
  for (const double value : {0.0, 1e-6, 0.3, 0.3, 250.0, std::numeric_limits<double>::infinity()}) {
    histogram.add(value);
  }
  EXPECT_EQ(Histogram::parse(histogram.text()), histogram);
  for (const char* broken : {"", "3", "3:", "x:1", "3:1;", "3:-1"}) {
    EXPECT_FALSE(Histogram::parse(broken)) << broken;
  }
}

}  // namespace
}  // namespace adit
