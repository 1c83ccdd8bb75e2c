#include <gtest/gtest.h>

#include <random>

#include "adit/motion/odometry.hpp"
#include "adit/motion/pose_history.hpp"

namespace adit {
namespace {

TEST(DeadReckoning, AgreesWithSampledMoves) {
  const OdometryNoise noise{0.05, 0.01, 0.05, 0.0, 0.0};
  PoseWithCovariance start{{2, 3, 1.0}, Matrix3d::Zero()};
  start.covariance.diagonal() << 1e-4, 2e-4, 1e-5;
  const Pose2 move{1.6, 0.1, 0.3};
  const PoseWithCovariance after = dead_reckon(start, move, noise);

  std::mt19937_64 random(5);
  std::normal_distribution<double> normal;
  const double metres = move.translation().norm();
  const double rotation_sigma = 0.01 * metres + 0.05 * 0.3;
  Matrix3d sampled = Matrix3d::Zero();
  const int count = 50000;
  for (int i = 0; i < count; ++i) {
    Pose2 from = start.pose;
    from.x += 1e-2 * normal(random);
    from.y += std::sqrt(2e-4) * normal(random);
    from.theta += std::sqrt(1e-5) * normal(random);
    // The heading error builds up along the way: half of it turns the translation.
    const double turn = rotation_sigma * normal(random);
    const Pose2 half{0, 0, 0.5 * turn};
    Pose2 moved = half * Pose2{move.x + 0.05 * metres * normal(random),
                               move.y + 0.05 * metres * normal(random), move.theta};
    moved.theta = move.theta + turn;
    const Vector3d error = (from * moved).vector() - after.pose.vector();
    sampled += error * error.transpose() / count;
  }
  EXPECT_LT((sampled - after.covariance).norm(), 0.05 * sampled.norm());
}

TEST(DeadReckoning, AStandingMachineKeepsItsFloors) {
  const Matrix3d covariance = move_covariance({}, {0.1, 0.1, 0.1, 0.01, 0.002});
  EXPECT_NEAR(covariance(0, 0), 1e-4, 1e-12);
  EXPECT_NEAR(covariance(2, 2), 4e-6, 1e-12);
}

TEST(PoseHistory, InterpolatesBetweenAndHoldsBeyond) {
  PoseHistory history;
  EXPECT_FALSE(history.at(0.0, 1.0).has_value());
  history.add({1.0, {0, 0, 3.0}});
  history.add({2.0, {2, 4, -3.0}});
  const Pose2 middle = *history.at(1.5, 0.0);
  EXPECT_NEAR(middle.x, 1.0, 1e-12);
  EXPECT_NEAR(middle.y, 2.0, 1e-12);
  EXPECT_NEAR(std::abs(middle.theta), kPi, 1e-12);  // through the seam, the smaller turn
  EXPECT_EQ(history.at(0.5, 1.0)->x, 0.0);
  EXPECT_EQ(history.at(9.0, 8.0)->x, 2.0);
  EXPECT_FALSE(history.at(9.0, 1.0).has_value());
  EXPECT_FALSE(history.at(0.5, 0.1).has_value());
  EXPECT_FALSE(history.at(std::nan(""), 1.0).has_value());
}

TEST(PoseHistory, SortsLatePosesReplacesEqualStampsAndStaysBounded) {
  PoseHistory history(8);
  history.add({3.0, {3, 0, 0}});
  history.add({1.0, {1, 0, 0}});
  history.add({2.0, {5, 0, 0}});
  history.add({2.0, {2, 0, 0}});
  EXPECT_EQ(history.size(), 3u);
  EXPECT_NEAR(history.at(2.5, 0.0)->x, 2.5, 1e-12);
  EXPECT_EQ(history.poses().front().stamp, 1.0);
  EXPECT_EQ(history.poses().back().stamp, 3.0);
  for (int i = 0; i < 100; ++i) history.add({10.0 + i, {10.0 + i, 0, 0}});
  EXPECT_LE(history.size(), 8u);
  EXPECT_NEAR(history.at(108.5, 0.0)->x, 108.5, 1e-12);
}

}  // namespace
}  // namespace adit
