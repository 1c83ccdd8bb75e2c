#include "adit/tracking/pose_tracker.hpp"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "adit/simulation/random.hpp"

namespace adit {
namespace {

const OdometryNoise kNoNoise{0.0, 0.0, 0.0, 0.0, 0.0};

Matrix3d diagonal(double x, double y, double theta) {
  return Vector3d(x, y, theta).cwiseAbs2().asDiagonal();
}

/// A covariance of pose that is turned and skewed any way; sigmas of about so many metres.
Matrix3d random_covariance(Random& random, double metres) {
  Matrix3d root;
  for (int i = 0; i < 9; ++i) root(i / 3, i % 3) = metres * random.normal();
  root.row(2) *= 0.2;
  return root * root.transpose() + diagonal(0.1 * metres, 0.1 * metres, 0.02 * metres);
}

Vector3d random_vector(Random& random) {
  return {random.normal(), random.normal(), random.normal()};
}

/// A fix with this covariance, of which this part is noise and the rest the map's error.
PoseObservation fix(const Pose2& pose, const Matrix3d& covariance, const Matrix3d& noise) {
  PoseObservation observation;
  observation.pose = pose;
  observation.information = covariance.inverse();
  observation.noise_information = noise.inverse();
  return observation;
}

double least_eigenvalue(const Matrix3d& symmetric) {
  return Eigen::SelfAdjointEigenSolver<Matrix3d>(symmetric).eigenvalues()[0];
}

TEST(PoseTracker, WithAPerfectMapIsTheKalmanFilter) {
  Random random(1);
  TrackingOptions options;
  options.gate_chi_square = 1e9;
  PoseTracker tracker;
  PoseWithCovariance expected{{1.0, 2.0, 3.0}, diagonal(0.3, 0.2, 0.05)};
  tracker.start(expected);
  for (int i = 0; i < 300; ++i) {
    const Pose2 move{0.5 * random.normal(), 0.2 * random.normal(), 0.3 * random.normal()};
    tracker.predict(move, {}, options);
    expected = dead_reckon(expected, move, {});
    const Matrix3d covariance = random_covariance(random, 0.1);
    PoseObservation observation = fix(expected.pose, covariance, covariance);
    observation.pose = Pose2::from_vector(observation.pose.vector() + 0.1 * random_vector(random));
    observation.score = 5.0 * random_vector(random);
    tracker.update(observation, options);

    const Matrix3d fixed = fix_covariance(observation.information);
    const Vector3d innovation =
        difference(expected.pose, observation.pose) + fixed * observation.score;
    const Matrix3d gain = expected.covariance * (expected.covariance + fixed).inverse();
    expected.pose = Pose2::from_vector(expected.pose.vector() + gain * innovation);
    expected.covariance = (Matrix3d::Identity() - gain) * expected.covariance;
    ASSERT_LT(difference(expected.pose, tracker.estimate().pose).norm(), 1e-9);
    ASSERT_LT((expected.covariance - tracker.estimate().covariance).norm(),
              1e-9 * expected.covariance.norm());
  }
}

TEST(PoseTracker, TheScoreIsAsGoodAsTheFixItLeadsTo) {
  const Matrix3d covariance = diagonal(0.1, 0.2, 0.02);
  PoseObservation at_fix = fix({1.0, 2.0, 0.3}, covariance, 0.5 * covariance);
  PoseObservation beside = at_fix;
  const Vector3d aside(0.3, -0.2, 0.05);
  beside.pose = Pose2::from_vector(at_fix.pose.vector() - aside);
  beside.score = fix_covariance(beside.information).inverse() * aside;
  PoseTracker one;
  PoseTracker other;
  for (PoseTracker* tracker : {&one, &other}) {
    tracker->start({{1.1, 1.9, 0.28}, diagonal(0.2, 0.2, 0.1)});
  }
  EXPECT_NEAR(one.chi_square(at_fix), other.chi_square(beside), 1e-9);
  const double before = one.chi_square(at_fix);
  EXPECT_DOUBLE_EQ(one.update(at_fix, {}), before);
  other.update(beside, {});
  EXPECT_LT(difference(one.estimate().pose, other.estimate().pose).norm(), 1e-12);
  EXPECT_LT((one.estimate().covariance - other.estimate().covariance).norm(), 1e-12);
}

TEST(PoseTracker, TheSameFixAgainAndAgainLeavesTheBias) {
  Random random(2);
  for (int world = 0; world < 100; ++world) {
    // Axes, skewed in any way, on which prediction, noise and bias are each independent.
    const Matrix3d axes = random_covariance(random, 1.0).llt().matrixL();
    const double share_y = random.uniform();
    const double share_x = random.uniform();
    const Vector3d bias_share = 0.05 * Vector3d(share_x, share_y, 1.0);
    const Matrix3d prior = axes * axes.transpose();
    const Matrix3d bias = axes * bias_share.asDiagonal() * axes.transpose();
    const Matrix3d noise = 0.3 * random.uniform() * bias;
    PoseTracker tracker;
    tracker.start({{}, prior});
    for (int i = 0; i < 2000; ++i) {
      tracker.predict({}, kNoNoise, {});
      tracker.update(fix({}, noise + bias, noise), {});
    }
    // The noise is averaged away; of the bias no more than what the first guess knows.
    const Matrix3d left = (prior.inverse() + bias.inverse()).inverse();
    const Matrix3d& covariance = tracker.estimate().covariance;
    for (int axis = 0; axis < 100; ++axis) {
      const Vector3d direction = axes.inverse().transpose() * random_vector(random);
      const double least = direction.dot(left * direction);
      EXPECT_GT(direction.dot(covariance * direction), 0.999 * least);
      EXPECT_LT(direction.dot(covariance * direction), 1.1 * least);
    }
  }
}

TEST(PoseTracker, TheWayMakesOfBiasWhatTheNextScanMayAverage) {
  const Matrix3d noise = diagonal(0.001, 0.001, 1e-4);
  const Matrix3d bias = diagonal(0.1, 0.1, 0.01);
  const auto sigma_after = [&](double metres) {
    PoseTracker tracker;
    tracker.start({{}, diagonal(5.0, 5.0, 0.1)});
    for (int i = 0; i < 100; ++i) {
      // There and back along y, so that the lever of the heading cancels.
      tracker.predict({0.0, i % 2 == 0 ? metres : -metres, 0.0}, kNoNoise, {});
      tracker.update(fix(tracker.estimate().pose, noise + bias, noise), {});
    }
    return std::sqrt(tracker.estimate().covariance(1, 1));
  };
  EXPECT_GT(sigma_after(0.0), 0.0999);
  EXPECT_GT(sigma_after(0.0), 1.05 * sigma_after(2.0));
  EXPECT_GT(sigma_after(2.0), 1.5 * sigma_after(20.0));
  // A hundred fixes that have nothing to do with each other.
  EXPECT_NEAR(sigma_after(1000.0), 0.01, 0.001);
}

/// The variance of the best mix of two fixes of the same noise and bias, the second taken so far on
/// that this part of the bias' variance is still the same error; by trying every mix.
double best_of_two(double noise, double bias, double kept) {
  double least = noise + bias;
  for (double share = 0.0; share <= 1.0; share += 1e-5) {
    const double rest = 1.0 - share;
    const double independent = rest * rest * (noise + (1.0 - kept) * bias) + share * share * noise;
    const double same = rest * std::sqrt(kept * bias) + share * std::sqrt(bias);
    least = std::min(least, independent + same * same);
  }
  return least;
}

TEST(PoseTracker, MixesTwoFixesAsWellAsTheirBiasAllows) {
  const TrackingOptions options{.bias_distance_m = 10.0, .gate_chi_square = 1e9};
  const double noise = 0.0001;
  const double bias = 0.01;
  for (const double metres : {0.0, 0.1, 1.0, 5.0, 20.0, 100.0}) {
    PoseTracker tracker;
    tracker.start({{}, 1e4 * Matrix3d::Identity()});
    const Matrix3d unit = Matrix3d::Identity();
    tracker.update(fix({}, (noise + bias) * unit, noise * unit), options);
    tracker.predict({metres, 0.0, 0.0}, kNoNoise, options);
    tracker.update(fix(tracker.estimate().pose, (noise + bias) * unit, noise * unit), options);
    const double expected = best_of_two(noise, bias, std::exp(-2.0 * metres / 10.0));
    EXPECT_NEAR(tracker.estimate().covariance(0, 0), expected, 1e-4 * expected) << metres;
  }
}

TEST(PoseTracker, AnUnobservedDirectionKeepsTheVarianceOfDeadReckoning) {
  Random random(3);
  for (int world = 0; world < 50; ++world) {
    const Vector2d along = unit_vector(random.uniform(-kPi, kPi));
    const Vector3d across(-along.y(), along.x(), 0.0);
    PoseTracker tracker;
    const Pose2 start{3.0, -1.0, 0.4};
    const Vector3d first(along.x(), along.y(), 0.0);
    // Sure of the heading, so that only the way itself is uncertain along the drift.
    tracker.start({start, 0.04 * Matrix3d::Identity()});
    double variance = 0.04;
    for (int i = 0; i < 20; ++i) {
      tracker.blur(0.1, 0.0);
      variance += 0.01;
      PoseObservation observation;
      observation.pose = Pose2::from_vector(tracker.estimate().pose.vector() + 0.01 * across);
      observation.information = 1e4 * (across * across.transpose());
      observation.information(2, 2) = 1e5;
      observation.noise_information = 4.0 * observation.information;
      const Pose2 before = tracker.estimate().pose;
      tracker.update(observation, {});
      const Vector3d step = difference(before, tracker.estimate().pose);
      EXPECT_NEAR(first.dot(step), 0.0, 1e-5);
    }
    const Matrix3d& covariance = tracker.estimate().covariance;
    EXPECT_NEAR(first.dot(covariance * first), variance, 1e-3 * variance);
    EXPECT_LT(across.dot(covariance * across), 2e-4);
  }
}

TEST(PoseTracker, AFixBeyondTheGateMakesThePredictionUnsure) {
  const Matrix3d covariance = diagonal(0.05, 0.05, 0.01);
  const Matrix3d prior = diagonal(0.1, 0.1, 0.02);
  const TrackingOptions options;
  const auto update = [&](double metres) {
    PoseTracker tracker;
    tracker.start({{}, prior});
    const double chi_square = tracker.update(fix({metres, 0.0, 0.0}, covariance, covariance), {});
    EXPECT_NEAR(chi_square, metres * metres / (0.01 + 0.0025), 1e-3 * chi_square);
    return tracker.estimate();
  };
  const double at_gate = std::sqrt(options.gate_chi_square * 0.0125);
  const PoseWithCovariance within = update(0.99 * at_gate);
  const PoseWithCovariance beyond = update(4.0 * at_gate);
  EXPECT_NEAR(within.pose.x, 0.8 * 0.99 * at_gate, 1e-4);
  // Sixteen times the variance of the prediction: the fix rules.
  EXPECT_NEAR(beyond.pose.x, 64.0 / 65.0 * 4.0 * at_gate, 1e-3);
  EXPECT_GT(beyond.covariance(0, 0), 1.2 * within.covariance(0, 0));
  EXPECT_LT(beyond.covariance(0, 0), 0.0025);
}

TEST(PoseTracker, BlurAddsVarianceInEveryDirection) {
  PoseTracker tracker;
  const Matrix3d before = diagonal(0.1, 0.2, 0.3);
  tracker.start({{1.0, 2.0, 3.0}, before});
  tracker.blur(0.5, 0.1);
  EXPECT_LT((tracker.estimate().covariance - before - diagonal(0.5, 0.5, 0.1)).norm(), 1e-9);
  EXPECT_EQ(tracker.estimate().pose.vector(), Vector3d(1.0, 2.0, 3.0));
}

TEST(PoseTracker, AStartForgetsAllThatWasBefore) {
  Random random(4);
  PoseTracker used;
  used.start({{}, diagonal(0.5, 0.5, 0.1)});
  for (int i = 0; i < 10; ++i)
    used.update(fix({}, diagonal(0.1, 0.1, 0.1), 1e-6 * diagonal(1, 1, 1)), {});
  PoseTracker fresh;
  const PoseWithCovariance start{{1.0, -2.0, 0.5}, random_covariance(random, 0.2)};
  for (PoseTracker* tracker : {&used, &fresh}) {
    tracker->start(start);
    tracker->update(fix({1.1, -2.0, 0.5}, diagonal(0.1, 0.1, 0.1), diagonal(0.05, 0.1, 0.02)), {});
  }
  EXPECT_EQ(used.estimate().covariance, fresh.estimate().covariance);
  EXPECT_EQ(used.estimate().pose.vector(), fresh.estimate().pose.vector());
}

TEST(PoseTracker, AStartWithoutAnyDoubtIsAStart) {
  PoseTracker tracker;
  tracker.start({{1.0, 2.0, 0.3}, Matrix3d::Zero()});
  const double chi_square = tracker.update(
      fix({1.01, 2.0, 0.3}, diagonal(0.1, 0.1, 0.01), diagonal(0.05, 0.05, 0.005)), {});
  EXPECT_NEAR(chi_square, 0.01, 1e-4);
  EXPECT_NEAR(tracker.estimate().pose.x, 1.0, 1e-6);
  EXPECT_GT(least_eigenvalue(tracker.estimate().covariance), 0.0);
}

TEST(PoseTracker, TheCovarianceStaysOneOverTenThousandSteps) {
  Random random(6);
  PoseTracker tracker;
  tracker.start({{}, diagonal(0.3, 0.3, 0.1)});
  for (int i = 0; i < 10000; ++i) {
    const Pose2 move{random.normal(), 0.1 * random.normal(), random.normal()};
    tracker.predict(move, random.chance(0.1) ? kNoNoise : OdometryNoise{}, {});
    if (random.chance(0.01)) {
      const double turn = 0.3 * random.uniform();
      tracker.blur(random.uniform(), turn);
    }
    if (random.chance(0.3)) continue;
    const Matrix3d noise = random_covariance(random, std::pow(10.0, random.uniform(-4.0, 0.0)));
    const Matrix3d bias = random_covariance(random, std::pow(10.0, random.uniform(-4.0, 0.0)));
    PoseObservation observation = fix(tracker.estimate().pose, noise + bias, noise);
    if (random.chance(0.3)) {  // along a drift
      const Vector3d seen(0.6, 0.8, 0.1);
      observation.information = 1e4 * seen * seen.transpose();
      observation.noise_information = 4.0 * observation.information;
    }
    observation.pose = Pose2::from_vector(observation.pose.vector() + 0.1 * random_vector(random));
    tracker.update(observation, {});
    const PoseWithCovariance& estimate = tracker.estimate();
    ASSERT_TRUE(estimate.pose.is_finite());
    ASSERT_LE(std::abs(estimate.pose.theta), kPi);
    ASSERT_EQ(estimate.covariance, estimate.covariance.transpose());
    ASSERT_GT(least_eigenvalue(estimate.covariance), 0.0) << i;
  }
}

TEST(FixCovariance, IsTheInverseWhereThereIsInformation) {
  Random random(7);
  for (int i = 0; i < 100; ++i) {
    const Matrix3d covariance = random_covariance(random, 0.1);
    EXPECT_LT((fix_covariance(covariance.inverse()) - covariance).norm(), 1e-4 * covariance.norm());
  }
  EXPECT_GT(fix_covariance(Matrix3d::Zero())(0, 0), 1e4);
  const Matrix3d drift = fix_covariance(Vector3d(0.0, 1e4, 1e4).asDiagonal());
  EXPECT_GT(drift(0, 0), 1e4);
  EXPECT_NEAR(drift(1, 1), 1e-4, 1e-9);
}

}  // namespace
}  // namespace adit
