#include "adit/map/vertex_grid.hpp"

#include <gtest/gtest.h>

#include <random>

#include "support/draws.hpp"

namespace adit {
namespace {

int nearest_by_force(const VertexGrid& grid, const Vector2d& center, double radius, int except) {
  int best = -1;
  double best_distance = radius;
  for (int v = 0; v < static_cast<int>(grid.positions().size()); ++v) {
    const double away = (grid.position(v) - center).norm();
    if (v == except || away > best_distance || (best >= 0 && away == best_distance)) continue;
    best = v;
    best_distance = away;
  }
  return best;
}

TEST(VertexGrid, nearest_is_what_brute_force_finds) {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> place(-1.0, 1.0);
  std::uniform_real_distribution<double> slip(-0.04, 0.04);
  VertexGrid grid(0.01, 0);  // expects nothing: must grow
  for (int i = 0; i < 3000; ++i) grid.add({place(random), place(random)});
  for (int i = 0; i < 3000; i += 7) {
    grid.move(i, grid.position(i) + test::drawn<2>([&] { return slip(random); }));
  }
  int hits = 0;
  for (int i = 0; i < 2000; ++i) {
    const Vector2d center = test::drawn<2>([&] { return place(random); });
    const int except = i % 5 == 0 ? nearest_by_force(grid, center, 1.0, -1) : -1;
    const double radius = i % 2 == 0 ? 0.01 : 0.03;
    const int found = grid.nearest(center, radius, except);
    EXPECT_EQ(found, nearest_by_force(grid, center, radius, except));
    hits += found >= 0 ? 1 : 0;
  }
  EXPECT_GT(hits, 500);
  EXPECT_LT(hits, 1990);
}

TEST(VertexGrid, ties_go_to_the_first) {
  VertexGrid grid(0.01, 4);
  grid.add({0.0, 0.0});
  grid.add({0.01, 0.0});
  grid.add({0.0, 0.0});
  EXPECT_EQ(grid.nearest({0.005, 0.0}, 0.01), 0);
  EXPECT_EQ(grid.nearest({0.0, 0.0}, 0.01, 0), 2);
  EXPECT_EQ(grid.nearest({1.0, 0.0}, 0.01), -1);
}

}  // namespace
}  // namespace adit
