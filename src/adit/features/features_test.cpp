#include "adit/features/features.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <random>

namespace adit {
namespace {

Line wall(const Vector2d& begin, const Vector2d& end) {
  Line line;
  line.begin = begin;
  line.end = end;
  const Vector2d along = (end - begin).normalized();
  line.orientation = std::atan2(-along.x(), along.y());
  line.distance = unit_vector(line.orientation).dot(begin);
  return line;
}

TEST(Features, ALineSeenFromAnotherFrameStillHoldsItsPoints) {
  Line line = wall({3, -1}, {4, 5});
  line.covariance << 1e-4, 0, 0, 1e-4;
  const Pose2 b_from_a{1, -2, 2.5};
  const Line moved = transform(line, b_from_a);
  const Vector2d normal = unit_vector(moved.orientation);
  EXPECT_NEAR(normal.dot(b_from_a * line.begin), moved.distance, 1e-12);
  EXPECT_NEAR(normal.dot(b_from_a * line.end), moved.distance, 1e-12);
  EXPECT_NEAR((moved.begin - b_from_a * line.begin).norm(), 0.0, 1e-12);
}

TEST(Features, CovariancesMoveAsSampledLinesDo) {
  Line line = wall({3, -1}, {4, 5});
  line.covariance << 1e-6, 5e-7, 5e-7, 4e-6;
  const Pose2 b_from_a{10, -20, 2.5};
  const Matrix2d predicted = transform(line, b_from_a).covariance;
  const double mean = transform(line, b_from_a).distance;
  std::mt19937_64 random(1);
  std::normal_distribution<double> normal;
  double sampled = 0.0;
  const int count = 20000;
  for (int i = 0; i < count; ++i) {
    const double z0 = normal(random), z1 = normal(random);
    Line drawn = line;
    drawn.orientation += 1e-3 * z0;
    drawn.distance += 5e-4 * z0 + std::sqrt(4e-6 - 2.5e-7) * z1;
    const double error = transform(drawn, b_from_a).distance - mean;
    sampled += error * error / count;
  }
  EXPECT_NEAR(sampled / predicted(1, 1), 1.0, 0.05);
}

TEST(Features, CornersTurnWithTheirBisectors) {
  FeatureList list;
  Corner corner;
  corner.position = {2, 0};
  corner.covariance << 4, 0, 0, 1;
  corner.bisector = 3.0;
  list.corners.push_back(corner);
  FeatureList moved;
  transform(list, {0, 0, kPi / 2}, moved);
  EXPECT_NEAR(moved.corners[0].position.y(), 2.0, 1e-12);
  EXPECT_NEAR(*moved.corners[0].bisector, wrap_angle(3.0 + kPi / 2), 1e-12);
  EXPECT_NEAR(moved.corners[0].covariance(1, 1), 4.0, 1e-12);
  EXPECT_NEAR(moved.corners[0].covariance(0, 0), 1.0, 1e-12);
}

TEST(Features, OrderIsCounterClockwiseAndALineSortsByItsMiddle) {
  FeatureList list;
  list.lines.push_back(wall({1, -1}, {1, 3}));
  for (const double azimuth : {2.0, -3.0, -0.9, 1.3}) {
    Corner corner;
    corner.position = 2.0 * unit_vector(azimuth);
    list.corners.push_back(corner);
  }
  sort_counter_clockwise(list);
  ASSERT_EQ(list.order.size(), 5u);
  for (std::size_t i = 1; i < 5; ++i) EXPECT_LT(list.order[i - 1].azimuth, list.order[i].azimuth);
  EXPECT_EQ(list.order[2].kind, FeatureKind::line);
  EXPECT_NEAR(list.order[2].azimuth, 0.5 * (std::atan2(-1, 1) + std::atan2(3, 1)), 1e-9);
}

}  // namespace
}  // namespace adit
