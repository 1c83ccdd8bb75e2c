#include "adit/extraction/extraction.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <limits>
#include <random>

#include "adit/geometry/segment.hpp"

namespace adit {
namespace {

double ray(const std::vector<Segment>& walls, const Vector2d& origin, const Vector2d& direction) {
  double nearest = std::numeric_limits<double>::infinity();
  for (const Segment& wall : walls) {
    const Vector2d along = wall.b - wall.a;
    const double denominator = cross(direction, along);
    if (denominator == 0.0) continue;
    const double range = cross(wall.a - origin, along) / denominator;
    const double at = cross(wall.a - origin, direction) / denominator;
    if (range > 0.0 && at >= 0.0 && at <= 1.0) nearest = std::min(nearest, range);
  }
  return nearest;
}

std::vector<Segment> polygon(const std::vector<Vector2d>& corners) {
  std::vector<Segment> walls;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    walls.push_back({corners[i], corners[(i + 1) % corners.size()]});
  }
  return walls;
}

const std::vector<Segment> kRoom = polygon({{-4, -3}, {6, -3}, {6, 5}, {-4, 5}});

struct View {
  int beams = 1000;
  double field_of_view = kTwoPi;
  double sigma = 0.0;
  double step = 0.0;  // of the ranges
  unsigned seed = 1;
};

LaserScan look(const std::vector<Segment>& walls, const Pose2& pose, const View& view) {
  std::mt19937_64 random(view.seed);
  std::normal_distribution<double> noise(0.0, 1.0);
  LaserScan scan;
  const bool circle = view.field_of_view >= kTwoPi;
  scan.bearing_step = view.field_of_view / (circle ? view.beams : view.beams - 1);
  scan.first_bearing = -0.5 * view.field_of_view;
  scan.max_range = 50.0;
  for (int i = 0; i < view.beams; ++i) {
    const double bearing = pose.theta + scan.bearing(static_cast<std::size_t>(i));
    double range =
        ray(walls, pose.translation(), unit_vector(bearing)) + view.sigma * noise(random);
    if (view.step > 0.0) range = std::round(range / view.step) * view.step;
    scan.ranges.push_back(range);
  }
  return scan;
}

ScannerModel model_of(const View& view) {
  ScannerModel model;
  model.range_sigma_m = std::max(view.sigma, 1e-3);
  model.quantisation_m = view.step;
  model.max_range_m = 50.0;
  return model;
}

/// Sensed corners with both arms within `reach` of a point.
int corners_near(const FeatureList& features, const Vector2d& point, double reach) {
  int count = 0;
  for (const Corner& corner : features.corners) {
    if (corner.concave_angle && (corner.position - point).norm() < reach) ++count;
  }
  return count;
}

class FieldsOfView : public testing::TestWithParam<std::tuple<int, int>> {};

TEST_P(FieldsOfView, FindTheCornersOfARoomThatTheyShow) {
  const auto [beams, fov_degrees] = GetParam();
  for (const double heading : {0.0, 0.7, 1.9, 3.1, -2.2}) {
    const Pose2 pose{0.5, 0.8, heading};
    const View view{beams, radians(fov_degrees), 0.01, 0.0, 3};
    Extractor extractor;
    const FeatureList& features = extractor.extract(look(kRoom, pose, view), model_of(view), {});
    int expected = 0;
    for (const Segment& wall : kRoom) {
      const Vector2d seen = inverse(pose) * wall.a;
      // A corner near the rim of the field of view has too short an arm to count on.
      const double azimuth = std::abs(std::atan2(seen.y(), seen.x()));
      const double margin = radians(12);
      if (fov_degrees < 360 && azimuth > radians(fov_degrees / 2) - margin) continue;
      ++expected;
      EXPECT_EQ(corners_near(features, seen, 0.15), 1) << wall.a.transpose() << " at " << heading;
    }
    EXPECT_GT(expected, 0);
    int with_angle = 0;
    for (const Corner& corner : features.corners) {
      if (!corner.concave_angle) continue;
      ++with_angle;
      EXPECT_NEAR(*corner.concave_angle, kPi / 2, 0.1);
    }
    if (fov_degrees == 360) {
      EXPECT_EQ(with_angle, 4);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(BeamsAndDegrees, FieldsOfView,
                         testing::Combine(testing::Values(180, 361, 1000, 4000),
                                          testing::Values(180, 270, 360)));

TEST(Extraction, AFullCircleHasNoSeam) {
  // The first beam points into the middle of a wall: that wall is one line all the same.
  const View view{1000, kTwoPi, 0.02, 0.0, 5};
  Extractor extractor;
  const FeatureList& features =
      extractor.extract(look(kRoom, {0.5, 0.8, 0.0}, view), model_of(view), {});
  ASSERT_EQ(features.lines.size(), 4u);
  ASSERT_EQ(features.corners.size(), 4u);
  for (const Corner& corner : features.corners) {
    EXPECT_FALSE(corner.occluding);
    EXPECT_GE(corner.arms[0], 0);
    EXPECT_GE(corner.arms[1], 0);
  }
}

TEST(Extraction, ClockwiseScannersGiveTheSameFeatures) {
  const View view{721, kTwoPi, 0.01, 0.0, 9};
  const LaserScan forward = look(kRoom, {0.5, 0.8, 0.3}, view);
  LaserScan backward = forward;
  std::reverse(backward.ranges.begin(), backward.ranges.end());
  backward.first_bearing = forward.bearing(forward.ranges.size() - 1);
  backward.bearing_step = -forward.bearing_step;
  Extractor a, b;
  const FeatureList& one = a.extract(forward, model_of(view), {});
  const FeatureList& other = b.extract(backward, model_of(view), {});
  ASSERT_EQ(one.lines.size(), other.lines.size());
  ASSERT_EQ(one.corners.size(), other.corners.size());
  for (std::size_t i = 0; i < one.order.size(); ++i) {
    EXPECT_NEAR(one.order[i].azimuth, other.order[i].azimuth, 1e-9);
  }
}

TEST(Extraction, ABeamThatRepeatsTheFirstMakesNoSeam) {
  // From -pi to pi inclusive, as many drivers give it: 361 beams of one degree.
  LaserScan scan = look(kRoom, {0.5, 0.8, 0.0}, {360, kTwoPi, 0.01, 0.0, 5});
  scan.ranges.push_back(scan.ranges.front());
  Extractor extractor;
  const FeatureList& features = extractor.extract(scan, model_of({360, kTwoPi, 0.01, 0.0, 5}), {});
  EXPECT_EQ(features.lines.size(), 4u);
  EXPECT_EQ(features.corners.size(), 4u);
}

TEST(Extraction, AStraightWallHasNoCornerInAThousandNoisyScans) {
  const std::vector<Segment> wall = {{{3, -20}, {3, 20}}};
  int corners = 0;
  int walls = 0;
  for (unsigned seed = 0; seed < 1000; ++seed) {
    const View view{500, radians(160), 0.1, 0.1, seed};
    Extractor extractor;
    const FeatureList& features = extractor.extract(look(wall, {}, view), model_of(view), {});
    for (const Line& line : features.lines) walls += line.length() > 15.0 ? 1 : 0;
    for (const Corner& c : features.corners) corners += c.concave_angle ? 1 : 0;
  }
  EXPECT_LE(corners, 10);
  EXPECT_GE(walls, 990);
}

TEST(Extraction, FindsTheMockupsColumnsInCycloneNoise) {
  // A column of 0.4 m, five metres away, in the noise of the Cyclone (0.1 m).
  const std::vector<Segment> walls = {{{5, -12}, {5, -0.2}},
                                      {{5, -0.2}, {4.6, -0.2}},
                                      {{4.6, -0.2}, {4.6, 0.2}},
                                      {{4.6, 0.2}, {5, 0.2}},
                                      {{5, 0.2}, {5, 12}}};
  double shift = 0.0;
  int long_lines = 0;
  int columns = 0;
  const int runs = 200;
  for (unsigned seed = 0; seed < runs; ++seed) {
    const View view{1000, kTwoPi, 0.1, 0.1, seed};
    Extractor extractor;
    bool column = false;
    for (const Line& line : extractor.extract(look(walls, {}, view), model_of(view), {}).lines) {
      if (line.length() > 5.0) {
        shift += line.distance - 5.0;
        ++long_lines;
      }
      const Vector2d middle = 0.5 * (line.begin + line.end);
      column = column || (line.length() < 1.5 && (middle - Vector2d(4.75, 0.0)).norm() < 0.4);
    }
    columns += column ? 1 : 0;
  }
  ASSERT_GT(long_lines, 350);
  EXPECT_NEAR(shift / long_lines, 0.0, 0.01);  // the column does not pull the wall towards it
  EXPECT_GT(columns, 150);                     // a fifth is lost in the noise
}

TEST(Extraction, TheEdgeBeforeADropIsAnOccludingCornerAndItsShadowIsNone) {
  const std::vector<Segment> walls = {{{2, -2}, {2, 0.5}}, {{6, -9}, {6, 9}}};
  const View view{1000, kTwoPi, 0.01, 0.0, 2};
  const LaserScan whole = look(walls, {}, view);
  // The beam at the jump may also be missing, on either side, as filtered mixed pixels are.
  const auto edge = static_cast<std::size_t>((std::atan2(0.5, 2.0) + kPi) / whole.bearing_step);
  for (const std::size_t missing : {std::size_t{0}, edge, edge + 1}) {
    LaserScan scan = whole;
    if (missing > 0) scan.ranges[missing] = scan.max_range;
    Extractor extractor;
    int at_edge = 0;
    int at_shadow = 0;
    for (const Corner& corner : extractor.extract(scan, model_of(view), {}).corners) {
      if ((corner.position - Vector2d(2, 0.5)).norm() < 0.05) {
        ++at_edge;
        EXPECT_TRUE(corner.occluding);
        EXPECT_FALSE(corner.concave_angle.has_value());
        EXPECT_GE(corner.arms[0], 0);  // the wall comes before its end, counter-clockwise
        EXPECT_EQ(corner.arms[1], -1);
      }
      if ((corner.position - Vector2d(6, 1.5)).norm() < 0.3) ++at_shadow;
    }
    EXPECT_EQ(at_edge, 1) << missing;
    EXPECT_EQ(at_shadow, 0) << missing;
  }
}

TEST(Extraction, OddGeometriesAreHarmless) {
  Extractor extractor;
  for (const double step : {0.0, std::numeric_limits<double>::quiet_NaN(), 1e9, -1e-300}) {
    for (const std::size_t beams : {std::size_t{1}, std::size_t{50}}) {
      LaserScan scan;
      scan.bearing_step = step;
      scan.ranges.assign(beams, 5.0);
      for (const Line& line : extractor.extract(scan, {}, {}).lines) {
        EXPECT_TRUE(std::isfinite(line.distance));
      }
    }
  }
}

TEST(Extraction, FewScatteredPointsAndEmptyScansGiveNothing) {
  Extractor extractor;
  LaserScan scan;
  scan.max_range = 50.0;
  scan.bearing_step = kTwoPi / 100;
  EXPECT_EQ(extractor.extract(scan, {}, {}).size(), 0u);
  scan.ranges.assign(100, std::numeric_limits<double>::quiet_NaN());
  EXPECT_EQ(extractor.extract(scan, {}, {}).size(), 0u);
  scan.ranges[10] = 5.0;
  scan.ranges[11] = 5.0;
  scan.ranges[50] = -3.0;
  scan.ranges[51] = std::numeric_limits<double>::infinity();
  EXPECT_EQ(extractor.extract(scan, {}, {}).size(), 0u);
}

struct Consistency {
  double nees = 0.0;
  int count = 0;
  int covered = 0;
  void add(double chi_square) {
    nees += chi_square;
    ++count;
    covered += chi_square < 5.9915 ? 1 : 0;
  }
  double per_dof() const { return nees / (2.0 * count); }
  double coverage() const { return static_cast<double>(covered) / count; }
};

TEST(Extraction, CovariancesHoldForLinesAndCornersOfARoom) {
  for (const double sigma : {0.01, 0.1}) {
    Consistency lines, corners;
    for (unsigned seed = 100; seed < 500; ++seed) {
      const View view{1000, kTwoPi, sigma, sigma, seed};
      const Pose2 pose{0.5 + 0.002 * seed, 0.8, 0.01 * seed};
      Extractor extractor;
      const FeatureList& features = extractor.extract(look(kRoom, pose, view), model_of(view), {});
      for (const Segment& wall : kRoom) {
        const Segment seen{inverse(pose) * wall.a, inverse(pose) * wall.b};
        const Vector2d along = (seen.b - seen.a).normalized();
        const Vector2d normal(along.y(), -along.x());
        for (const Line& line : features.lines) {
          const double turn = angle_between(std::atan2(normal.y(), normal.x()), line.orientation);
          if (std::abs(turn) > 0.3) continue;
          const Vector2d error(turn, line.distance - normal.dot(seen.a));
          lines.add(error.dot(line.covariance.inverse() * error));
        }
        for (const Corner& corner : features.corners) {
          const Vector2d error = corner.position - seen.a;
          if (error.norm() > 1.0) continue;
          corners.add(error.dot(corner.covariance.inverse() * error));
        }
      }
    }
    EXPECT_GT(lines.count, 1550);
    EXPECT_NEAR(lines.per_dof(), 1.0, 0.15) << sigma;
    EXPECT_NEAR(lines.coverage(), 0.95, 0.02) << sigma;
    EXPECT_GT(corners.count, 1550);
    EXPECT_NEAR(corners.per_dof(), 1.0, 0.15) << sigma;
    EXPECT_NEAR(corners.coverage(), 0.95, 0.02) << sigma;
  }
}

}  // namespace
}  // namespace adit
