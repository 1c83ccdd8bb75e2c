#include "adit/refinement/corner_zone.hpp"

#include <gtest/gtest.h>

#include "support/casting.hpp"

namespace adit {
namespace {

using testing::map_of;

const MapError kError{0.1, 1.5, 0.0};

RefinementOptions options() {
  RefinementOptions result;
  result.corner_reach_ratio = 5.0;
  result.corner_sigma_ratio = 12.0;
  return result;
}

/// At a point of the only wall of a map that this point lies on.
double sigma_at(const LineMap& map, const Vector2d& hit, const MapError& error = kError) {
  BeamResidual beam;
  beam.gradient.setZero();
  beam.normal = beam.direction = Vector2d::Zero();
  beam.hit = hit;
  for (std::size_t i = 0; i < map.walls().size(); ++i) {
    if (distance(map.walls()[i].segment, hit) < 1e-9) beam.wall = static_cast<int>(i);
  }
  return corner_sigma(map, beam, error, options());
}

LineMap corner(const Vector2d& second_end) {
  return map_of({{Vector2d(0.0, 0.0), Vector2d(4.0, 0.0)}, {Vector2d(4.0, 0.0), second_end}});
}

TEST(CornerSigma, FallsFromTheCornerToTheReach) {
  const LineMap map = corner({4.0, 3.0});
  // Twelve map errors at the corner, none from five map errors on.
  EXPECT_NEAR(sigma_at(map, {4.0 - 1e-6, 0.0}), 1.2, 1e-4);
  EXPECT_NEAR(sigma_at(map, {3.75, 0.0}), 0.6, 1e-9);
  EXPECT_NEAR(sigma_at(map, {4.0, 0.25}), 0.6, 1e-9);
  EXPECT_NEAR(sigma_at(map, {3.51, 0.0}), 0.024, 1e-9);
  EXPECT_EQ(sigma_at(map, {3.49, 0.0}), 0.0);
  EXPECT_EQ(sigma_at(map, {2.0, 0.0}), 0.0);
}

TEST(CornerSigma, IsNoneWhereAWallEndsOrGoesOn) {
  EXPECT_EQ(sigma_at(corner({4.0, 3.0}), {0.1, 0.0}), 0.0);
  EXPECT_EQ(sigma_at(corner({8.0, 0.7}), {3.9, 0.0}), 0.0);  // ten degrees
  EXPECT_GT(sigma_at(corner({8.0, 4.0}), {3.9, 0.0}), 0.0);  // forty-five degrees
}

TEST(CornerSigma, IsNoneOnAMapThatIsRight) {
  EXPECT_EQ(sigma_at(corner({4.0, 3.0}), {3.99, 0.0}, {0.0, 1.5, 0.0}), 0.0);
}

}  // namespace
}  // namespace adit
