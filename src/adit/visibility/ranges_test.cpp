#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "adit/visibility/visibility.hpp"
#include "support/casting.hpp"

namespace adit {
namespace {

using testing::grid_segments;
using testing::is_right;
using testing::kInfinity;
using testing::map_of;
using testing::Sight;

struct Fan {
  double first;
  double step;
  std::size_t beams;
};

class VisibilityRanges : public ::testing::TestWithParam<Fan> {};

TEST_P(VisibilityRanges, LikeCastingBeamByBeam) {
  const Fan fan = GetParam();
  std::mt19937_64 random(5);
  Visibility visibility;
  std::vector<double> ranges(fan.beams);
  std::vector<int> walls(fan.beams);
  for (int world = 0; world < 20 && !HasFailure(); ++world) {
    Sight sight;
    sight.map = map_of(grid_segments(random, 12, 8));
    sight.observer = {4.1, 3.7};
    sight.max_range = 6.0;
    visibility.sweep(sight.map, sight.observer, sight.max_range);
    visibility.ranges(fan.first, fan.step, ranges, walls);
    for (std::size_t i = 0; i < fan.beams; ++i) {
      const double bearing = fan.first + static_cast<double>(i) * fan.step;
      EXPECT_TRUE(is_right(ranges[i], sight.map, sight.observer, bearing, sight.max_range));
      ASSERT_EQ(walls[i] < 0, std::isinf(ranges[i]));
      if (walls[i] < 0) continue;
      const Wall& wall = sight.map.walls()[static_cast<std::size_t>(walls[i])];
      EXPECT_LE(distance(wall.segment, sight.observer + ranges[i] * unit_vector(bearing)), 1e-9);
    }
  }
}

/// Whether the wall ends where the bearing passes, to the last bits.
bool ends_at(const Segment& segment, const Vector2d& observer, double bearing) {
  const Vector2d along = unit_vector(bearing);
  return std::abs(cross(along, segment.a - observer)) < 1e-9 ||
         std::abs(cross(along, segment.b - observer)) < 1e-9;
}

TEST_P(VisibilityRanges, WallsAreThoseOfTheRanges) {
  const Fan fan = GetParam();
  std::mt19937_64 random(6);
  Visibility visibility;
  std::vector<double> ranges(fan.beams);
  std::vector<int> walls(fan.beams);
  std::vector<int> alone(fan.beams);
  const Vector2d observer(4.1, 3.7);
  for (int world = 0; world < 20; ++world) {
    const auto map = map_of(grid_segments(random, 12, 8));
    visibility.sweep(map, observer, 6.0);
    visibility.ranges(fan.first, fan.step, ranges, walls);
    visibility.walls_along(fan.first, fan.step, alone);
    for (std::size_t i = 0; i < fan.beams; ++i) {
      if (alone[i] == walls[i]) continue;
      ASSERT_GE(alone[i], 0);
      const Wall& wall = map.walls()[static_cast<std::size_t>(alone[i])];
      const double bearing = fan.first + static_cast<double>(i) * fan.step;
      EXPECT_TRUE(ends_at(wall.segment, observer, bearing)) << "beam " << i;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Fans, VisibilityRanges,
                         ::testing::Values(Fan{-kPi, kTwoPi / 1000, 1000},
                                           Fan{0.0, kTwoPi / 1000, 1000},
                                           Fan{-0.5 * kPi, kPi / 180, 181},
                                           Fan{2.5, -kTwoPi / 333, 333}, Fan{-400.0, 0.01, 2000},
                                           Fan{3.0, -0.01, 2000}, Fan{kPi, 1e-4, 500},
                                           Fan{1.2, 0.0, 3}, Fan{0.3, 5.0, 40}, Fan{-2.0, 0.1, 1}));

TEST(Visibility, RangesWithoutWallsAndWithoutBeams) {
  Visibility visibility;
  visibility.sweep(map_of({{Vector2d(1, -1), Vector2d(1, 1)}}), Vector2d::Zero(), 5.0);
  visibility.ranges(0.0, 0.1, {});
  double range = 0.0;
  visibility.ranges(std::numeric_limits<double>::quiet_NaN(), 0.1, {&range, 1});
  EXPECT_EQ(range, kInfinity);
}

}  // namespace
}  // namespace adit
