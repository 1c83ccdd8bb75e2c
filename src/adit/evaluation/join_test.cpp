#include "adit/evaluation/join.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <random>

namespace adit {
namespace {

TEST(StampIndex, TakesTheNearestWithinAMillisecond) {
  const StampIndex index({10.0, 20.0, 20.0008, 5.0});
  EXPECT_EQ(index.nearest(10.0), 0U);
  EXPECT_EQ(index.nearest(10.0009), 0U);
  EXPECT_EQ(index.nearest(9.9991), 0U);
  EXPECT_EQ(index.nearest(10.0011), std::nullopt);
  EXPECT_EQ(index.nearest(9.9989), std::nullopt);
  EXPECT_EQ(index.nearest(20.0003), 1U);
  EXPECT_EQ(index.nearest(20.0005), 2U);
  EXPECT_EQ(index.nearest(5.0), 3U);
  EXPECT_EQ(index.nearest(20.0005, 0.0001), std::nullopt);
}

TEST(StampIndex, RepeatedStampsGiveTheFirstRow) {
  const StampIndex index({3.0, 7.0, 7.0, 7.0, 3.0});
  EXPECT_EQ(index.nearest(7.0), 1U);
  EXPECT_EQ(index.nearest(7.0004), 1U);
  EXPECT_EQ(index.nearest(6.9996), 1U);
  EXPECT_EQ(index.nearest(3.0004), 0U);
}

TEST(StampIndex, NothingToFind) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(StampIndex({}).nearest(0.0), std::nullopt);
  EXPECT_EQ(StampIndex({nan}).nearest(0.0), std::nullopt);
  EXPECT_EQ(StampIndex({nan, 1.0}).nearest(1.0), 1U);
  EXPECT_EQ(StampIndex({1.0}).nearest(nan), std::nullopt);
}

TEST(StampIndex, AgreesWithBruteForceOnShuffledStamps) {
  std::mt19937_64 random(1);
  std::uniform_int_distribution<int> tick(0, 400);
  for (int round = 0; round < 200; ++round) {
    std::vector<double> stamps;
    for (int i = 0; i < 30; ++i) stamps.push_back(0.25 * tick(random));
    const StampIndex index(stamps);
    const double wanted = 0.125 * tick(random);
    std::optional<std::size_t> best;
    for (std::size_t i = 0; i < stamps.size(); ++i) {
      const double gap = std::abs(stamps[i] - wanted);
      if (gap > 0.5) continue;
      const double best_gap = best ? std::abs(stamps[*best] - wanted) : 1e9;
      if (gap < best_gap || (gap == best_gap && stamps[i] < stamps[*best])) best = i;
    }
    EXPECT_EQ(index.nearest(wanted, 0.5), best);
  }
}

}  // namespace
}  // namespace adit
