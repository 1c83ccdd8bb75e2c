#include "adit/refinement/wall_neighbours.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <memory>
#include <random>
#include <utility>
#include <vector>

#include "support/casting.hpp"
#include "support/repeats.hpp"

namespace adit {
namespace {

using testing::grid_segments;
using testing::map_of;

constexpr std::size_t kMost = 16;  // neighbours that are kept of one wall

/// The walls within reach of one, nearest first, by looking at all. Walls of a cleaned map do not
/// cross, so that the nearest points of two are an end of either.
std::vector<std::pair<double, int>> neighbours(const LineMap& map, int wall, double reach) {
  std::vector<std::pair<double, int>> found;
  const Segment& here = map.walls()[static_cast<std::size_t>(wall)].segment;
  for (int other = 0; other < static_cast<int>(map.walls().size()); ++other) {
    const Segment& there = map.walls()[static_cast<std::size_t>(other)].segment;
    double metres = std::numeric_limits<double>::infinity();
    for (const Vector2d& end : {there.a, there.b}) metres = std::min(metres, distance(here, end));
    for (const Vector2d& end : {here.a, here.b}) metres = std::min(metres, distance(there, end));
    if (other != wall && metres <= reach) found.emplace_back(metres, other);
  }
  std::sort(found.begin(), found.end());
  return found;
}

/// Which of them come first where several are as near is not said: the distances must agree.
void expect_nearest(const LineMap& map, int wall, double reach, std::span<const WallLine> lines) {
  const auto all = neighbours(map, wall, reach);
  ASSERT_EQ(lines.size(), std::min(all.size(), kMost)) << wall;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const auto known = std::find_if(all.begin(), all.end(), [&](const auto& neighbour) {
      return neighbour.second == lines[i].wall;
    });
    ASSERT_NE(known, all.end()) << wall;
    EXPECT_NEAR(known->first, all[i].first, 1e-12) << wall;
    const auto named_again = [&](const WallLine& other) { return other.wall == lines[i].wall; };
    EXPECT_EQ(std::count_if(lines.begin(), lines.end(), named_again), 1);
  }
}

TEST(WallNeighbours, AreThoseThatLookingAtAllWallsFinds) {
  std::mt19937_64 random(1);
  for (int world = 0; world < 40; ++world) {
    const LineMap map = map_of(grid_segments(random, 15, 12));
    // No distance between points of the grid is one of these to the last bit.
    for (const double reach : {0.0513, 0.5171, 1.5137}) {
      WallNeighbours near;
      near.reset(map, reach);
      for (int wall = 0; wall < static_cast<int>(map.walls().size()); ++wall) {
        expect_nearest(map, wall, reach, near.of(wall));
      }
    }
  }
}

/// So many short walls beside each other.
LineMap fence(int walls, double apart) {
  std::vector<Segment> segments;
  for (int i = 0; i < walls; ++i) {
    segments.push_back({Vector2d(apart * i, 0.0), Vector2d(apart * i, 1.0)});
  }
  return map_of(segments);
}

TEST(WallNeighbours, WhereThereAreTooManyTheNearestAreKept) {
  const LineMap map = fence(100, 0.04);
  WallNeighbours near;
  near.reset(map, 1.0);
  for (int wall = 0; wall < 100; ++wall) {
    ASSERT_GT(neighbours(map, wall, 1.0).size(), kMost);
    expect_nearest(map, wall, 1.0, near.of(wall));
  }
}

TEST(WallNeighbours, MoreWallsThanAreKeptDoNotMixUp) {
  const LineMap map = fence(2000, 0.2);
  WallNeighbours near;
  near.reset(map, 0.3);
  std::mt19937_64 random(2);
  for (int i = 0; i < test::repeats(500); ++i) {
    // Multiples of a power of two apart, whatever the number that are kept.
    const int first = static_cast<int>(random() % 900);
    for (const int wall : {first, first + 1024, first, first + 512, first + 256, first}) {
      expect_nearest(map, wall, 0.3, near.of(wall));
    }
  }
}

TEST(WallNeighbours, AnotherMapOrReachStartsAnew) {
  const LineMap narrow = fence(30, 0.2);
  const LineMap wide = fence(30, 0.5);
  WallNeighbours near;
  near.reset(narrow, 0.3);
  expect_nearest(narrow, 7, 0.3, near.of(7));
  near.reset(wide, 0.3);
  expect_nearest(wide, 7, 0.3, near.of(7));
  near.reset(wide, 1.1);
  EXPECT_GT(near.of(7).size(), 2u);
  expect_nearest(wide, 7, 1.1, near.of(7));
}

TEST(WallNeighbours, AnotherMapInTheSamePlaceStartsAnew) {
  LineMap map = fence(30, 0.2);
  WallNeighbours near;
  near.reset(map, 0.3);
  expect_nearest(map, 7, 0.3, near.of(7));
  map = fence(30, 0.5);
  near.reset(map, 0.3);
  EXPECT_EQ(near.of(7).size(), 0u);
  expect_nearest(map, 7, 0.3, near.of(7));
}

TEST(WallNeighbours, ACopyServesOnWhereTheMapIsGone) {
  auto map = std::make_unique<LineMap>(fence(30, 0.2));
  const LineMap copy = *map;
  WallNeighbours near;
  near.reset(*map, 0.3);
  expect_nearest(*map, 7, 0.3, near.of(7));
  map.reset();
  near.reset(copy, 0.3);
  for (int wall = 0; wall < 30; ++wall) expect_nearest(copy, wall, 0.3, near.of(wall));
}

TEST(WallLine, IsTheWall) {
  const LineMap map = map_of({{Vector2d(1.0, 2.0), Vector2d(4.0, 6.0)}});
  const WallLine line = line_of(map, 0);
  const Segment& wall = map.walls()[0].segment;
  EXPECT_EQ(line.wall, 0);
  EXPECT_DOUBLE_EQ(line.length, 5.0);
  EXPECT_LT((line.foot + line.length * line.along - wall.b).norm(), 1e-12);
  EXPECT_EQ(line.foot, wall.a);
  EXPECT_NEAR(line.normal.dot(line.along), 0.0, 1e-12);
  EXPECT_NEAR(cross(line.along, line.normal), 1.0, 1e-12);
}

}  // namespace
}  // namespace adit
