#include "adit/estimation/estimation.hpp"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <random>

#include "support/draws.hpp"

namespace adit {
namespace {

/// A line seen counter-clockwise from begin to end, from the origin.
Line line_through(const Vector2d& begin, const Vector2d& end) {
  Line line;
  line.begin = begin;
  line.end = end;
  const Vector2d along = (end - begin).normalized();
  line.orientation = std::atan2(-along.x(), along.y());
  line.distance = unit_vector(line.orientation).dot(begin);
  line.points = 50;
  return line;
}

/// Four walls and their corners around the origin, counter-clockwise, in the model's axes.
FeatureList room() {
  const std::vector<Vector2d> vertices = {{5, -3}, {4, 4}, {-6, 3}, {-5, -4}};
  FeatureList list;
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    list.lines.push_back(line_through(vertices[i], vertices[(i + 1) % 4]));
    Corner corner;
    corner.position = vertices[i];
    corner.arms = {static_cast<int>((i + 3) % 4), static_cast<int>(i)};
    corner.points = 80;
    list.corners.push_back(corner);
  }
  sort_counter_clockwise(list);
  return list;
}

std::vector<FeaturePair> all_pairs(bool lines, bool corners) {
  std::vector<FeaturePair> pairs;
  for (int i = 0; i < 4; ++i) {
    if (corners) pairs.push_back({FeatureKind::corner, i, i});
    if (lines) pairs.push_back({FeatureKind::line, i, i});
  }
  return pairs;
}

/// The model as sensed from `pose` (model_from_sensed), with covariances and noise drawn from them.
FeatureList sense(const FeatureList& model, const Pose2& pose, double noise, unsigned seed) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  FeatureList sensed;
  transform(model, inverse(pose), sensed);
  for (Line& line : sensed.lines) {
    line.covariance << 1e-5, 2e-5, 2e-5, 4e-4;
    const Matrix2d root = Matrix2d(line.covariance).llt().matrixL();
    const Vector2d error = noise * (root * test::drawn<2>([&] { return normal(random); }));
    line.orientation = wrap_angle(line.orientation + error.x());
    line.distance += error.y();
  }
  for (Corner& corner : sensed.corners) {
    corner.covariance << 4e-4, 1e-4, 1e-4, 9e-4;
    const Matrix2d root = Matrix2d(corner.covariance).llt().matrixL();
    corner.position += noise * (root * test::drawn<2>([&] { return normal(random); }));
  }
  return sensed;
}

void expect_pose_near(const Pose2& actual, const Pose2& expected, double tolerance) {
  EXPECT_NEAR(actual.x, expected.x, tolerance);
  EXPECT_NEAR(actual.y, expected.y, tolerance);
  EXPECT_NEAR(angle_between(expected.theta, actual.theta), 0.0, tolerance);
}

EstimationOptions perfect_map() {
  EstimationOptions options;
  options.map_sigma_m = 0.0;
  return options;
}

struct Situation {
  Weighting weighting;
  bool lines;
  bool corners;
};

class ExactFeatures : public testing::TestWithParam<Situation> {};

TEST_P(ExactFeatures, GiveTheExactPoseFromNinetyDegreesAway) {
  const FeatureList model = room();
  EstimationOptions options = perfect_map();
  options.weighting = GetParam().weighting;
  options.gate_chi_square = 1e300;
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> metres(-1.5, 1.5), turn(-kPi, kPi), off(-1.55, 1.55);
  for (int i = 0; i < 500; ++i) {
    const Pose2 truth{metres(random), metres(random), turn(random)};
    const FeatureList sensed = sense(model, truth, 0.0, 1);
    const Pose2 start{metres(random), metres(random), wrap_angle(truth.theta + off(random))};
    FeatureEstimator estimator;
    const FeatureFit fit = estimator.fit(
        sensed, model, all_pairs(GetParam().lines, GetParam().corners), start, options);
    ASSERT_TRUE(fit.converged) << i;
    expect_pose_near(fit.pose, truth, 1e-6);
    if (GetParam().weighting == Weighting::covariance) {
      EXPECT_NEAR(fit.chi_square, 0.0, 1e-6);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Weightings, ExactFeatures,
                         testing::Values(Situation{Weighting::covariance, true, true},
                                         Situation{Weighting::covariance, true, false},
                                         Situation{Weighting::covariance, false, true},
                                         Situation{Weighting::points, true, true},
                                         Situation{Weighting::points, true, false},
                                         Situation{Weighting::points, false, true}));

TEST(Estimation, CovarianceAndChiSquareHoldUnderTheNoiseTheyAssume) {
  const FeatureList model = room();
  const Pose2 truth{0.4, -0.3, 0.7};
  double nees = 0.0;
  double chi_square = 0.0;
  int covered = 0;
  const int runs = 2000;
  int freedom = 0;
  for (unsigned seed = 0; seed < runs; ++seed) {
    const FeatureList sensed = sense(model, truth, 1.0, seed);
    FeatureEstimator estimator;
    EstimationOptions options = perfect_map();
    options.gate_chi_square = 1e9;
    const FeatureFit fit =
        estimator.fit(sensed, model, all_pairs(true, false), {0.3, -0.2, 0.6}, options);
    ASSERT_TRUE(fit.converged);
    const Vector3d error(fit.pose.x - truth.x, fit.pose.y - truth.y, fit.pose.theta - truth.theta);
    const double squared = error.dot(fit.covariance.inverse() * error);
    nees += squared / (3.0 * runs);
    covered += squared < 7.8147 ? 1 : 0;
    chi_square += fit.chi_square / runs;
    freedom = fit.degrees_of_freedom;
  }
  EXPECT_NEAR(nees, 1.0, 0.06);
  EXPECT_NEAR(static_cast<double>(covered) / runs, 0.95, 0.015);
  EXPECT_EQ(freedom, 5);
  EXPECT_NEAR(chi_square, freedom, 0.3);
}

TEST(Estimation, PointWeightsAndAPriorGiveAnHonestCovarianceTogether) {
  const FeatureList model = room();
  EstimationOptions options = perfect_map();
  options.weighting = Weighting::points;
  std::mt19937_64 random(8);
  std::normal_distribution<double> normal;
  for (const double noise : {1.0, 0.1}) {
    double nees = 0.0;
    const int runs = 500;
    for (unsigned seed = 0; seed < runs; ++seed) {
      PoseWithCovariance prior{{0.4, -0.3, 0.7}, Vector3d(4e-4, 4e-4, 1.6e-5).asDiagonal()};
      const Pose2 truth{prior.pose.x + 0.02 * normal(random), prior.pose.y + 0.02 * normal(random),
                        prior.pose.theta + 0.004 * normal(random)};
      const FeatureList sensed = sense(model, truth, noise, seed);
      FeatureEstimator estimator;
      const FeatureFit fit =
          estimator.fit(sensed, model, all_pairs(true, false), prior.pose, options, prior);
      ASSERT_TRUE(fit.converged);
      const Vector3d error(fit.pose.x - truth.x, fit.pose.y - truth.y,
                           fit.pose.theta - truth.theta);
      nees += error.dot(fit.covariance.inverse() * error) / (3.0 * runs);
    }
    // The lines state a covariance ten times too large in the second case.
    if (noise == 1.0) {
      EXPECT_NEAR(nees, 1.0, 0.15);
    } else {
      EXPECT_LT(nees, 1.0);
    }
  }
}

TEST(Estimation, ACornerOfMatchedLinesTellsNothingNew) {
  const FeatureList model = room();
  const FeatureList sensed = sense(model, {0.1, 0.1, 0.1}, 1.0, 3);
  FeatureEstimator estimator;
  const FeatureFit lines = estimator.fit(sensed, model, all_pairs(true, false), {}, perfect_map());
  const FeatureFit both = estimator.fit(sensed, model, all_pairs(true, true), {}, perfect_map());
  EXPECT_TRUE(lines.covariance.isApprox(both.covariance, 1e-9));
  expect_pose_near(both.pose, lines.pose, 1e-9);
}

TEST(Estimation, OneLineTwiceMatchedCountsOnce) {
  FeatureList model = room();
  const FeatureList sensed = sense(model, {0.1, 0.1, 0.1}, 0.0, 3);
  model.lines.push_back(model.lines[0]);  // the wall's other half, beyond an opening
  std::vector<FeaturePair> pairs = all_pairs(true, false);
  FeatureEstimator estimator;
  const Matrix3d once = estimator.fit(sensed, model, pairs, {}, perfect_map()).covariance;
  pairs.push_back({FeatureKind::line, 0, 4});
  const Matrix3d twice = estimator.fit(sensed, model, pairs, {}, perfect_map()).covariance;
  EXPECT_TRUE(once.isApprox(twice, 1e-9));
}

TEST(Estimation, DropsThePairThatIsWrong) {
  // Of two opposite walls nobody could tell which is wrong; a third one across them can.
  FeatureList model = room();
  model.lines.push_back(line_through({2, 3}, {-3, 2.4}));
  const Pose2 truth{0.2, -0.1, 0.05};
  FeatureList sensed = sense(model, truth, 0.0, 3);
  sensed.lines[1].distance += 0.5;
  std::vector<FeaturePair> pairs = all_pairs(true, false);
  pairs.push_back({FeatureKind::line, 4, 4});
  FeatureEstimator estimator;
  const FeatureFit fit = estimator.fit(sensed, model, pairs, {}, perfect_map());
  ASSERT_TRUE(fit.converged);
  EXPECT_EQ(fit.dropped, 1);
  ASSERT_EQ(estimator.pairs_used().size(), 4u);
  for (const FeaturePair& pair : estimator.pairs_used()) EXPECT_NE(pair.sensed, 1);
  expect_pose_near(fit.pose, truth, 1e-6);
}

TEST(Estimation, WhatTwoParallelWallsDoNotTellComesFromThePrior) {
  FeatureList model;
  model.lines.push_back(line_through({-9, -2}, {9, -2}));
  model.lines.push_back(line_through({9, 2}, {-9, 2}));
  const Pose2 truth{0.0, 0.3, 0.02};
  const FeatureList sensed = sense(model, truth, 0.0, 3);
  const std::vector<FeaturePair> pairs = {{FeatureKind::line, 0, 0}, {FeatureKind::line, 1, 1}};
  FeatureEstimator estimator;
  EXPECT_FALSE(estimator.fit(sensed, model, pairs, {}, perfect_map()).converged);

  PoseWithCovariance prior{{0.7, 0.0, 0.0}, Vector3d(0.25, 0.25, 0.01).asDiagonal()};
  const FeatureFit fit = estimator.fit(sensed, model, pairs, prior.pose, perfect_map(), prior);
  ASSERT_TRUE(fit.converged);
  EXPECT_NEAR(fit.pose.x, 0.7, 1e-3);  // along the walls: as believed before
  EXPECT_NEAR(fit.pose.y, 0.3, 2e-3);  // across: as seen
  EXPECT_NEAR(fit.covariance(0, 0), 0.25, 1e-3);
  EXPECT_LT(fit.covariance(1, 1), 1e-3);
}

TEST(Estimation, AnOccludingCornerOfAMatchedLineTellsWhereAlongIt) {
  FeatureList model;
  model.lines.push_back(line_through({3, -4}, {3, 2}));
  Corner edge;
  edge.position = {3, 2};
  edge.arms = {0, -1};
  edge.occluding = true;
  model.corners.push_back(edge);
  const Pose2 truth{0.2, 0.4, 0.0};
  FeatureList sensed = sense(model, truth, 0.0, 3);
  const std::vector<FeaturePair> pairs = {{FeatureKind::line, 0, 0}, {FeatureKind::corner, 0, 0}};
  FeatureEstimator estimator;
  const FeatureFit fit = estimator.fit(sensed, model, pairs, {}, perfect_map());
  ASSERT_TRUE(fit.converged);
  EXPECT_EQ(fit.degrees_of_freedom, 0);  // two of the line, one of the corner
  expect_pose_near(fit.pose, truth, 1e-6);
}

TEST(Estimation, NoPairsAndNoPriorDoNotConverge) {
  FeatureEstimator estimator;
  const FeatureFit fit = estimator.fit({}, {}, {}, {1, 2, 3}, perfect_map());
  EXPECT_FALSE(fit.converged);
  EXPECT_EQ(fit.used, 0);
}

}  // namespace
}  // namespace adit
