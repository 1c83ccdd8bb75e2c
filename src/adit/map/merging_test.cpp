#include "adit/map/merging.hpp"

#include <gtest/gtest.h>

#include <random>

namespace adit {
namespace {

std::vector<int> kept_of(const std::vector<Vector2d>& line, double offset) {
  std::vector<int> kept{99};
  simplify(line, offset, kept);
  return kept;
}

TEST(Simplify, of_lines_without_inside) {
  EXPECT_TRUE(kept_of({}, 0.1).empty());
  EXPECT_EQ(kept_of({{0.0, 0.0}}, 0.1), (std::vector<int>{0}));
  EXPECT_EQ(kept_of({{0.0, 0.0}, {0.01, 0.0}}, 0.1), (std::vector<int>{0, 1}));
}

TEST(Simplify, keeps_a_corner_and_a_turning_point) {
  EXPECT_EQ(kept_of({{0.0, 0.0}, {1.0, 0.0}, {2.0, 0.0}, {2.0, 1.0}, {2.0, 2.0}}, 0.01),
            (std::vector<int>{0, 2, 4}));
  EXPECT_EQ(kept_of({{0.0, 0.0}, {1.0, 0.0}, {3.0, 0.0}, {2.0, 0.0}}, 0.01),
            (std::vector<int>{0, 2, 3}));
}

TEST(Simplify, stays_within_the_offset_of_random_walks) {
  std::mt19937_64 random(17);
  std::normal_distribution<double> turn(0.0, 0.2);
  for (const double offset : {0.0, 0.05, 0.5}) {
    for (int trial = 0; trial < 200; ++trial) {
      std::vector<Vector2d> line{{0.0, 0.0}};
      double heading = 0.0;
      for (int i = 0; i < 60; ++i) {
        heading += turn(random);
        line.push_back(line.back() + unit_vector(heading) * std::abs(turn(random)));
      }
      const auto kept = kept_of(line, offset);
      ASSERT_EQ(kept.front(), 0);
      ASSERT_EQ(kept.back(), 60);
      for (std::size_t k = 0; k + 1 < kept.size(); ++k) {
        const auto at = [&](int i) { return line[static_cast<std::size_t>(i)]; };
        const Segment joined{at(kept[k]), at(kept[k + 1])};
        ASSERT_LT(kept[k], kept[k + 1]);
        for (int i = kept[k]; i <= kept[k + 1]; ++i) {
          EXPECT_LE(distance(joined, at(i)), offset + 1e-12);
        }
      }
      if (offset == 0.5) {
        EXPECT_LT(kept.size(), 30U);
      }
    }
  }
}

}  // namespace
}  // namespace adit
