#include "adit/simulation/ray_caster.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <limits>

#include "adit/simulation/random.hpp"

namespace adit {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Points on a coarse lattice as often as anywhere: shared ends, crossings and collinear walls.
Vector2d draw_point(Random& random, double extent) {
  const double x = random.uniform(-extent, extent);
  const double y = random.uniform(-extent, extent);
  return random.chance(0.5) ? Vector2d(std::round(x), std::round(y)) : Vector2d(x, y);
}

std::vector<Segment> draw_segments(Random& random, int count, double extent, double longest) {
  std::vector<Segment> segments;
  for (int i = 0; i < count; ++i) {
    const Vector2d a = draw_point(random, extent);
    segments.push_back({a, a + draw_point(random, longest)});
  }
  return segments;
}

TEST(CastRay, MeetsAWallWhereGeometrySays) {
  const Segment wall{{2.0, -1.0}, {2.0, 3.0}};
  EXPECT_DOUBLE_EQ(cast_ray(wall, {0.0, 0.0}, {1.0, 0.0}), 2.0);
  EXPECT_DOUBLE_EQ(cast_ray(wall, {0.0, 0.0}, unit_vector(radians(45.0))), std::sqrt(8.0));
  EXPECT_EQ(cast_ray(wall, {0.0, 0.0}, {-1.0, 0.0}), kInfinity) << "it lies behind";
  EXPECT_EQ(cast_ray(wall, {0.0, 0.0}, unit_vector(radians(60.0))), kInfinity) << "past its end";
}

TEST(CastRay, EndsBelongToTheWall) {
  const Segment wall{{2.0, 0.0}, {2.0, 3.0}};
  EXPECT_DOUBLE_EQ(cast_ray(wall, {0.0, 0.0}, {1.0, 0.0}), 2.0);
}

TEST(CastRay, PassesWallsSeenEdgeOn) {
  EXPECT_EQ(cast_ray({{1.0, 0.0}, {3.0, 0.0}}, {0.0, 0.0}, {1.0, 0.0}), kInfinity);
  EXPECT_EQ(cast_ray({{0.0, -1.0}, {0.0, 1.0}}, {0.0, 0.0}, {1.0, 0.0}), kInfinity)
      << "an observer on the wall looks away from it";
  EXPECT_EQ(cast_ray({{1.0, 0.0}, {1.0, 0.0}}, {0.0, 0.0}, {1.0, 0.0}), kInfinity);
}

TEST(CastRay, TakesTheNearestWithinRange) {
  const std::vector<Segment> walls{{{5.0, -1.0}, {5.0, 1.0}}, {{3.0, -1.0}, {3.0, 1.0}}};
  EXPECT_DOUBLE_EQ(cast_ray(walls, {0.0, 0.0}, {1.0, 0.0}), 3.0);
  EXPECT_EQ(cast_ray(walls, {0.0, 0.0}, {1.0, 0.0}, 2.9), kInfinity);
  EXPECT_EQ(cast_ray(std::vector<Segment>{}, {0.0, 0.0}, {1.0, 0.0}), kInfinity);
}

RC_GTEST_PROP(RayCaster, GivesTheNumbersOfBruteForce, (std::uint64_t seed)) {
  Random random(seed);
  const double extent = random.chance(0.5) ? 5.0 : 300.0;
  const double longest = random.chance(0.5) ? 3.0 : 2.0 * extent;
  const int count = random.below(120);
  const std::vector<Segment> segments = draw_segments(random, count, extent, longest);
  const RayCaster caster(segments);
  for (int i = 0; i < 200; ++i) {
    const Vector2d origin = draw_point(random, 1.5 * extent);
    const double bearing =
        random.chance(0.3) ? radians(45.0 * random.below(8)) : random.uniform(-kPi, kPi);
    const double reach = random.chance(0.5) ? kInfinity : random.uniform(0.0, extent);
    const Vector2d direction = unit_vector(bearing);
    RC_ASSERT(caster.range(origin, direction, reach) ==
              cast_ray(segments, origin, direction, reach));
  }
}

TEST(RayCaster, AgreesInALargeMineWithSevenDigitCoordinates) {
  Random random(7);
  std::vector<Segment> segments = draw_segments(random, 20000, 400.0, 3.0);
  const Vector2d easting_northing(4512345.678, 5801234.567);
  for (Segment& s : segments) {
    s.a += easting_northing;
    s.b += easting_northing;
  }
  const RayCaster caster(segments);
  for (int i = 0; i < 500; ++i) {
    const Vector2d origin = easting_northing + draw_point(random, 400.0);
    const Vector2d direction = unit_vector(random.uniform(-kPi, kPi));
    ASSERT_EQ(caster.range(origin, direction, 50.0), cast_ray(segments, origin, direction, 50.0));
  }
}

TEST(RayCaster, CopesWithNoWallsAndBadWalls) {
  EXPECT_EQ(RayCaster().range({0.0, 0.0}, {1.0, 0.0}), kInfinity);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const std::vector<Segment> walls{{{nan, 0.0}, {1.0, 1.0}}, {{2.0, -1.0}, {2.0, 1.0}}};
  EXPECT_DOUBLE_EQ(RayCaster(walls).range({0.0, 0.0}, {1.0, 0.0}), 2.0);
}

TEST(Random, HasTheMomentsOfItsDistributions) {
  Random random(3);
  const int count = 200000;
  double sum = 0.0;
  double squares = 0.0;
  double fourth = 0.0;
  double uniform = 0.0;
  for (int i = 0; i < count; ++i) {
    const double z = random.normal();
    sum += z;
    squares += z * z;
    fourth += z * z * z * z;
    uniform += random.uniform(2.0, 4.0);
  }
  EXPECT_NEAR(sum / count, 0.0, 0.01);
  EXPECT_NEAR(squares / count, 1.0, 0.015);
  EXPECT_NEAR(fourth / count, 3.0, 0.12);
  EXPECT_NEAR(uniform / count, 3.0, 0.01);
}

TEST(Random, StreamsAndSeedsDiffer) {
  EXPECT_EQ(Random(1, 2).bits(), Random(1, 2).bits());
  EXPECT_NE(Random(1, 2).bits(), Random(1, 3).bits());
  EXPECT_NE(Random(1, 2).bits(), Random(2, 2).bits());
}

}  // namespace
}  // namespace adit
