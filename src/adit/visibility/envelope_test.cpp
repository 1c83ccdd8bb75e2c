#include "adit/visibility/envelope.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "adit/geometry/segment.hpp"
#include "adit/visibility/bearing_key.hpp"

namespace adit {
namespace {

SweptWall swept(Vector2d begin, Vector2d end, int index) {
  if (cross(begin, end) < 0.0) std::swap(begin, end);
  SweptWall wall;
  wall.begin = begin;
  wall.end = end;
  wall.inverse_range = (end - begin) / cross(begin, end);
  wall.rounding = 1e-12;
  wall.begin_key = bearing_key(begin);
  wall.end_key = bearing_key(end);
  wall.wall = index;
  return wall;
}

bool spans(const SweptWall& wall, const Vector2d& direction) {
  return cross(wall.begin, direction) >= 0.0 && cross(direction, wall.end) >= 0.0;
}

/// Index of the nearest wall along a direction, -1 for none.
int nearest(const std::vector<SweptWall>& walls, const Vector2d& direction) {
  int best = -1;
  double best_inverse = 0.0;
  for (const SweptWall& wall : walls) {
    const double inverse = cross(direction, wall.inverse_range);
    if (!spans(wall, direction) || inverse <= best_inverse) continue;
    best = wall.wall;
    best_inverse = inverse;
  }
  return best;
}

int found(const Envelope& envelope, double key) {
  for (const Envelope::Piece& piece : envelope.pieces()) {
    if (piece.begin <= key && key < piece.end) return envelope.wall(piece.wall).wall;
  }
  return -1;
}

Vector2d somewhere(std::mt19937_64& random) {
  std::uniform_real_distribution<double> any(-10.0, 10.0);
  const double x = any(random);
  return {x, any(random)};
}

TEST(BearingKey, GrowsWithTheBearingAndComesBack) {
  double last = -2.0;
  for (int i = 1; i < 6283; ++i) {
    const Vector2d direction = unit_vector(-kPi + 0.001 * i);
    const double key = bearing_key(3.7 * direction);
    EXPECT_GT(key, last);
    EXPECT_NEAR(cross(key_direction(key), direction), 0.0, 1e-15);
    EXPECT_GT(key_direction(key).dot(direction), 0.0);
    last = key;
  }
  EXPECT_EQ(bearing_key({-1.0, 0.0}), 2.0);
  EXPECT_EQ(bearing_key({0.0, -5.0}), -1.0);
  EXPECT_EQ(bearing_key({1.0, 2.0}), bearing_key({3.0, 6.0}));
}

// Plans are cleaned of crossings, but not to the last bit: the envelope must bear any.
TEST(Envelope, CrossingWallsLikeBruteForce) {
  std::mt19937_64 random(1);
  Envelope envelope;
  for (int world = 0; world < 500; ++world) {
    std::vector<SweptWall> walls;
    const std::size_t count = random() % 40;
    for (std::size_t i = 0; i < count; ++i) {
      const Vector2d begin = somewhere(random);
      walls.push_back(swept(begin, somewhere(random), static_cast<int>(i)));
    }
    envelope.clear();
    for (std::size_t i = 0; i < count; ++i) {
      envelope.stage(walls[i]);
      if (random() % 8 == 0) envelope.merge_staged();  // the order must not matter
    }
    envelope.merge_staged();
    for (double key = -1.9995; key < 2.0; key += 0.01) {
      ASSERT_EQ(found(envelope, key), nearest(walls, key_direction(key))) << world << ' ' << key;
    }
  }
}

TEST(Envelope, HidesOnlyWhatIsHidden) {
  std::mt19937_64 random(2);
  Envelope envelope;
  int hidden = 0;
  for (int world = 0; world < 300; ++world) {
    std::vector<SweptWall> walls;
    envelope.clear();
    for (int i = 0; i < 12; ++i) {
      const Vector2d begin = somewhere(random);
      walls.push_back(swept(begin, somewhere(random), i));
      envelope.stage(walls.back());
    }
    envelope.merge_staged();
    envelope.measure_reach();
    const Vector2d begin = 3.0 * somewhere(random);
    const SweptWall wall = swept(begin, begin + somewhere(random), 12);
    const double distance = nearest_point({wall.begin, wall.end}, Vector2d::Zero()).norm();
    if (!envelope.hides(wall, distance * distance)) continue;
    ++hidden;
    walls.push_back(wall);
    for (double key = -1.9995; key < 2.0; key += 0.01) {
      ASSERT_NE(nearest(walls, key_direction(key)), 12);
    }
  }
  EXPECT_GT(hidden, 20);
}

}  // namespace
}  // namespace adit
