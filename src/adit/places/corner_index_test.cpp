#include "adit/places/corner_index.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace adit {
namespace {

std::vector<Sector> sectors_like(const CornerIndex& index, double opening_rad, double gap_m) {
  std::vector<Sector> out;
  index.visit({opening_rad, radians(5.0), gap_m}, [&](std::size_t, std::span<const Sector> run) {
    out.insert(out.end(), run.begin(), run.end());
  });
  return out;
}

/// A room of 10 m by 6 m, its lower left corner at (100, 50).
std::vector<Segment> room() {
  return {{{100.0, 50.0}, {110.0, 50.0}},
          {{110.0, 50.0}, {110.0, 56.0}},
          {{110.0, 56.0}, {100.0, 56.0}},
          {{100.0, 56.0}, {100.0, 50.0}}};
}

TEST(CornerOf, WallsMeetWhereTheirLinesDo) {
  const auto met = corner_of({{2.0, 0.0}, {9.0, 0.0}}, {{0.0, 8.0}, {0.0, 1.0}}, {});
  ASSERT_TRUE(met);
  EXPECT_NEAR(met->point.norm(), 0.0, 1e-12);
  EXPECT_NEAR((met->along_a - Vector2d(1.0, 0.0)).norm(), 0.0, 1e-12);
  EXPECT_NEAR((met->along_b - Vector2d(0.0, 1.0)).norm(), 0.0, 1e-12);
  EXPECT_NEAR(met->gap_m, 2.0, 1e-12);
}

TEST(CornerOf, NoneOfWallsThatAreShortParallelFarOrCross) {
  const CornerLimits limits;
  const Segment wall{{2.0, 0.0}, {9.0, 0.0}};
  EXPECT_FALSE(corner_of(wall, {{0.0, 2.0}, {0.0, 1.0}}, limits)) << "short";
  EXPECT_FALSE(corner_of(wall, {{0.0, 2.0}, {9.0, 3.0}}, limits)) << "nearly parallel";
  EXPECT_FALSE(corner_of(wall, {{0.0, 28.0}, {0.0, 12.0}}, limits)) << "far";
  EXPECT_FALSE(corner_of(wall, {{5.0, -3.0}, {5.0, 3.0}}, limits)) << "crossing";
}

TEST(CornerIndex, HoldsBothSidesOfEachCorner) {
  const CornerIndex index(LineMap::build(room()), {90.0, 40.0});
  const auto inside = sectors_like(index, 0.5 * kPi, 0.0);
  const auto outside = sectors_like(index, 1.5 * kPi, 0.0);
  ASSERT_EQ(inside.size(), 4u);
  EXPECT_EQ(outside.size(), 4u);
  bool found = false;
  for (const Sector& sector : inside) {
    if (std::hypot(sector.x - 10.0F, sector.y - 10.0F) > 1e-3F) continue;
    found = true;  // begins at the wall to the right, ends at the one upwards
    EXPECT_NEAR(sector.along_x, 1.0F, 1e-6F);
    EXPECT_NEAR(sector.along_y, 0.0F, 1e-6F);
    EXPECT_NEAR(sector.opening, 0.5 * kPi, 1e-6);
  }
  EXPECT_TRUE(found);
  EXPECT_TRUE(sectors_like(index, kPi, 8.0).empty());
}

TEST(CornerIndex, ChamferedCornersCountFromTheirGapOn) {
  // A room whose corners are cut off by two metres.
  const std::vector<Segment> walls{{{2.0, 0.0}, {8.0, 0.0}}, {{10.0, 2.0}, {10.0, 8.0}}};
  const CornerIndex index(LineMap::build(walls), {0.0, 0.0});
  EXPECT_TRUE(sectors_like(index, 0.5 * kPi, 1.0).empty());
  EXPECT_EQ(sectors_like(index, 0.5 * kPi, 2.5).size(), 1u);
}

TEST(CornerIndex, EmptyPlanHasNone) {
  const CornerIndex index(LineMap(), Vector2d::Zero());
  EXPECT_EQ(index.size(), 0u);
  EXPECT_TRUE(sectors_like(index, 0.5 * kPi, 8.0).empty());
}

}  // namespace
}  // namespace adit
