#include "adit/map/hilbert.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <numeric>
#include <random>

namespace adit {
namespace {

// The curve is known by two properties: it visits every cell once, and each next to the one before.
TEST(Hilbert, walks_every_cell_of_a_corner_in_single_steps) {
  constexpr std::uint32_t kSide = 64;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> cell_at(kSide * kSide, {kSide, kSide});
  for (std::uint32_t x = 0; x < kSide; ++x) {
    for (std::uint32_t y = 0; y < kSide; ++y) {
      const std::uint64_t key = hilbert_key(x, y);
      ASSERT_LT(key, cell_at.size());
      cell_at[key] = {x, y};
    }
  }
  for (std::size_t k = 0; k < cell_at.size(); ++k) {
    ASSERT_LT(cell_at[k].first, kSide) << "nothing at " << k;
    if (k == 0) continue;
    const auto dx = static_cast<int>(cell_at[k].first) - static_cast<int>(cell_at[k - 1].first);
    const auto dy = static_cast<int>(cell_at[k].second) - static_cast<int>(cell_at[k - 1].second);
    EXPECT_EQ(std::abs(dx) + std::abs(dy), 1) << "at " << k;
  }
}

// The same walk with the curve scaled up: all 64 bits of the key, all courses.
TEST(Hilbert, walks_the_whole_range_in_single_steps) {
  constexpr std::uint32_t kSide = 64;
  constexpr int kShift = 26;
  std::vector<std::pair<std::uint64_t, std::pair<int, int>>> cells;
  for (std::uint32_t x = 0; x < kSide; ++x) {
    for (std::uint32_t y = 0; y < kSide; ++y) {
      cells.push_back({hilbert_key(x << kShift, y << kShift) >> (2 * kShift),
                       {static_cast<int>(x), static_cast<int>(y)}});
    }
  }
  std::sort(cells.begin(), cells.end());
  for (std::size_t k = 0; k < cells.size(); ++k) {
    ASSERT_EQ(cells[k].first, k);
    if (k == 0) continue;
    const auto [x, y] = cells[k].second;
    const auto [old_x, old_y] = cells[k - 1].second;
    EXPECT_EQ(std::abs(x - old_x) + std::abs(y - old_y), 1) << "at " << k;
  }
}

TEST(Hilbert, order_names_every_segment_once) {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> place(-1e6, 1e6);
  std::vector<Segment> segments(1000);
  for (Segment& s : segments) s = {{place(random), place(random)}, {place(random), place(random)}};
  segments.push_back({{1e9, 1e9}, {1e9, 1e9}});
  std::vector<int> order = hilbert_order(segments);
  std::sort(order.begin(), order.end());
  std::vector<int> all(segments.size());
  std::iota(all.begin(), all.end(), 0);
  EXPECT_EQ(order, all);
  EXPECT_TRUE(hilbert_order({}).empty());
  const std::vector<Segment> same(3, Segment{{1.0, 2.0}, {1.0, 2.0}});
  EXPECT_EQ(hilbert_order(same), (std::vector<int>{0, 1, 2}));
}

}  // namespace
}  // namespace adit
