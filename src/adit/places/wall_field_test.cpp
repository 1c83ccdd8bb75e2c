#include "adit/places/wall_field.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace adit {
namespace {

/// Two walls that face each other across six metres.
std::vector<Segment> drift() {
  return {{{100.0, 50.0}, {140.0, 50.0}}, {{140.0, 56.0}, {100.0, 56.0}}};
}

TEST(WallField, MeetsTheWallNearestToAPoint) {
  const LineMap map = LineMap::build(drift());
  const WallField field(map);
  for (const double x : {101.0, 120.3, 139.0}) {
    const Vector2d below(x, 50.4);
    const auto met = field.meet(below);
    ASSERT_TRUE(met) << x;
    const Segment& wall = map.walls()[static_cast<std::size_t>(met->wall)].segment;
    EXPECT_NEAR(wall.a.y(), 50.0, 1e-9);
    EXPECT_NEAR((below - met->off * met->normal).y(), 50.0, 1e-4);
    EXPECT_NEAR(met->normal.norm(), 1.0, 1e-6);
  }
}

TEST(WallField, MeetsNothingFarFromAllWalls) {
  const WallField field(LineMap::build(drift()));
  EXPECT_FALSE(field.meet({120.0, 53.0}));
  EXPECT_FALSE(field.meet({-1e6, 1e6}));
  EXPECT_FALSE(WallField(LineMap()).meet({0.0, 0.0}));
}

TEST(WallField, MeetsNoWallBeyondItsEnd) {
  const WallField field(LineMap::build(drift()));
  EXPECT_TRUE(field.meet({140.2, 50.0}));
  EXPECT_FALSE(field.meet({140.6, 50.0}));
}

TEST(WallField, CodesHowFarThePlanIsFromAWall) {
  const WallField field(LineMap::build(drift()));
  const auto off = [&](const Vector2d& point) {
    const Vector2d here = point - field.origin();
    return field.off_code(static_cast<float>(here.x()), static_cast<float>(here.y()));
  };
  for (const double y : {50.1, 50.6, 51.2}) {
    const double metres = static_cast<double>(WallField::kOffStep) * off({120.0, y});
    EXPECT_NEAR(metres, y - 50.0, 0.26) << y;  // half a square
  }
  EXPECT_EQ(off({120.0, 53.0}), WallField::kFarOff);
  EXPECT_EQ(off({-1e6, 1e6}), WallField::kFarOff);
}

TEST(WallField, KnowsWhatLiesBehindAWall) {
  const WallField field(LineMap::build(drift()));
  const auto is_between = [&](const Vector2d& from, const Vector2d& to) {
    const Vector2d a = from - field.origin();
    const Vector2d b = to - field.origin();
    return field.is_between(static_cast<float>(a.x()), static_cast<float>(a.y()),
                            static_cast<float>(b.x()), static_cast<float>(b.y()), 0.5F);
  };
  EXPECT_TRUE(is_between({120.0, 53.0}, {121.0, 48.0}));
  EXPECT_FALSE(is_between({120.0, 53.0}, {120.0, 49.8})) << "not far enough behind";
  EXPECT_FALSE(is_between({105.0, 53.0}, {135.0, 53.5})) << "along the drift";
  EXPECT_FALSE(is_between({142.0, 53.0}, {142.0, 45.0})) << "beyond its end";
  EXPECT_FALSE(is_between({-1e6, 53.0}, {-1e6, 45.0})) << "off the plan";
}

TEST(WallField, CoversNothingOfAPlanWithWallsAstray) {
  std::vector<Segment> walls = drift();
  walls.push_back({{4e7, 4e7}, {4e7 + 10.0, 4e7}});
  const WallField field(LineMap::build(walls));
  EXPECT_FALSE(field.meet({120.0, 50.1}));
  EXPECT_LT(field.memory(), 1000u);
}

}  // namespace
}  // namespace adit
