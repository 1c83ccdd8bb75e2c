#include "adit/survey/pose_graph.hpp"

#include <gtest/gtest.h>

namespace adit {
namespace {

const Matrix3d kGood = Vector3d(1e4, 1e4, 1e5).asDiagonal();

/// Poses on a circle, each seen from the one before, and the last from the first.
std::vector<Pose2> circle(std::size_t count) {
  std::vector<Pose2> poses;
  Pose2 pose;
  const double turn = kTwoPi / static_cast<double>(count);
  for (std::size_t i = 0; i < count; ++i) {
    poses.push_back(pose);
    pose = pose * Pose2{1.0, 0.0, turn};
  }
  return poses;
}

std::vector<PoseConstraint> constraints_of(const std::vector<Pose2>& poses) {
  std::vector<PoseConstraint> out;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const std::size_t next = (i + 1) % poses.size();
    out.push_back({i, next, inverse(poses[i]) * poses[next], kGood, 0.0});
  }
  return out;
}

double worst(const std::vector<Pose2>& a, const std::vector<Pose2>& b) {
  double out = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) out = std::max(out, difference(a[i], b[i]).norm());
  return out;
}

TEST(PoseGraph, FindsThePosesThatFulfilAllConstraints) {
  const std::vector<Pose2> truth = circle(24);
  std::vector<Pose2> poses = truth;
  for (std::size_t i = 1; i < poses.size(); ++i) {
    poses[i] = poses[i - 1] * Pose2{1.05, 0.02, kTwoPi / 24.0 + 0.01};
  }
  ASSERT_GT(worst(truth, poses), 0.3);
  const GraphSummary summary = solve_pose_graph(poses, constraints_of(truth), 50);
  EXPECT_TRUE(summary.converged);
  EXPECT_LT(worst(truth, poses), 1e-5);
}

TEST(PoseGraph, ARobustConstraintThatIsWrongPullsLittle) {
  const std::vector<Pose2> truth = circle(24);
  std::vector<PoseConstraint> constraints = constraints_of(truth);
  constraints.push_back({3, 15, Pose2{0.5, 0.5, 1.0}, kGood, 1.0});
  std::vector<Pose2> robust = truth;
  solve_pose_graph(robust, constraints, 50);
  constraints.back().robust_sigmas = 0.0;
  std::vector<Pose2> plain = truth;
  solve_pose_graph(plain, constraints, 50);
  EXPECT_LT(worst(truth, robust), 0.05);
  EXPECT_GT(worst(truth, plain), 0.5);
}

TEST(PoseGraph, LeavesPosesAloneThatNothingSpeaksOf) {
  std::vector<Pose2> poses = circle(3);
  const std::vector<Pose2> before = poses;
  EXPECT_TRUE(solve_pose_graph(poses, {}, 10).converged);
  EXPECT_EQ(worst(before, poses), 0.0);
}

TEST(RobustShare, FallsWhereARobustConstraintIsOff) {
  PoseConstraint constraint{0, 1, {1.0, 0.0, 0.0}, kGood, 0.0};
  EXPECT_EQ(robust_share(constraint, {}, {2.0, 0.0, 0.0}), 1.0);
  constraint.robust_sigmas = 3.0;
  EXPECT_EQ(robust_share(constraint, {}, {1.0, 0.0, 0.0}), 1.0);
  EXPECT_NEAR(robust_share(constraint, {}, {1.03, 0.0, 0.0}), 0.5, 1e-9);
}

}  // namespace
}  // namespace adit
