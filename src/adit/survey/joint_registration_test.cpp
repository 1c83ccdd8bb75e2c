#include "adit/survey/joint_registration.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "adit/simulation/random.hpp"

namespace adit {
namespace {

/// What is seen of a room of 9 m x 5 m with a niche from a pose in it.
ScanShape seen_from(const Pose2& pose, Random& random) {
  const std::vector<Vector2d> corners = {{0, 0}, {9, 0}, {9, 5}, {6, 5},
                                         {6, 6}, {5, 6}, {5, 5}, {0, 5}};
  const RigidTransform pose_from_map(inverse(pose));
  ScanShape shape;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Vector2d a = corners[i];
    const Vector2d along = corners[(i + 1) % corners.size()] - a;
    const Vector2d normal = perpendicular(along).normalized();
    for (double s = 0.05; s < along.norm(); s += 0.09) {
      const Vector2d point = a + s * along.normalized() + 0.01 * random.normal() * normal;
      shape.points.push_back(carry(pose_from_map, {point.cast<float>(), normal.cast<float>()}));
    }
  }
  return shape;
}

/// Keyframes there and back, and where they are thought to be.
struct Walk {
  std::vector<Keyframe> keyframes;
  std::vector<Pose2> truth;
  std::vector<Pose2> poses;
  std::vector<PoseConstraint> backbone;

  Walk() {
    Random random(2);
    for (std::size_t i = 0; i < 40; ++i) {
      const double x = i < 20 ? 1.0 + 0.35 * static_cast<double>(i)
                              : 1.0 + 0.35 * (39.0 - static_cast<double>(i));
      truth.push_back({x, i < 20 ? 2.0 : 3.0, i < 20 ? 0.0 : kPi});
      Keyframe k;
      k.scan = i;
      k.beam_sigma_m = 0.01;
      k.shape = seen_from(truth.back(), random);
      keyframes.push_back(std::move(k));
      const Vector3d off(0.04 * random.normal(), 0.04 * random.normal(), 0.01 * random.normal());
      poses.push_back(i == 0 ? truth[0] : Pose2::from_vector(truth.back().vector() + off));
      if (i > 0) {
        backbone.push_back({i - 1, i, inverse(truth[i - 1]) * truth[i],
                            Vector3d(1e4, 1e4, 1e5).asDiagonal(), 0.0});
      }
    }
  }
};

TEST(RegisterPairs, SaysWhereScansLieAgainstEachOther) {
  const Walk walk;
  const auto pairs = register_pairs(walk.keyframes, walk.poses, walk.backbone, {}, {}, 1);
  ASSERT_GT(pairs.size(), 200U);
  std::size_t far = 0;
  double worst = 0.0;
  for (const PoseConstraint& c : pairs) {
    const Pose2 truth = inverse(walk.truth[c.from]) * walk.truth[c.to];
    worst = std::max(worst, difference(truth, c.from_to).head<2>().norm());
    far += c.from > c.to ? c.from - c.to > 25 : c.to - c.from > 25;
  }
  EXPECT_LT(worst, 0.04);
  EXPECT_GT(far, 20U);  // the way back is laid onto the way there
  std::vector<Pose2> solved = walk.poses;
  solve_pose_graph(solved, pairs, 50);
  for (std::size_t i = 0; i < solved.size(); ++i) {
    EXPECT_LT(difference(walk.truth[i], solved[i]).head<2>().norm(), 0.012) << i;
  }
}

TEST(RegisterPairs, IsTheSameOnAnyNumberOfThreads) {
  const Walk walk;
  const auto one = register_pairs(walk.keyframes, walk.poses, walk.backbone, {}, {}, 1);
  const auto three = register_pairs(walk.keyframes, walk.poses, walk.backbone, {}, {}, 3);
  ASSERT_EQ(one.size(), three.size());
  for (std::size_t i = 0; i < one.size(); ++i) {
    EXPECT_EQ(one[i].from, three[i].from);
    EXPECT_EQ(one[i].to, three[i].to);
    EXPECT_EQ(one[i].from_to.vector(), three[i].from_to.vector());
  }
}

TEST(RegisterPairs, KeepsToTheNumberThatIsAffordable) {
  const Walk walk;
  JointOptions options;
  options.most_pairs = 200;
  const auto pairs = register_pairs(walk.keyframes, walk.poses, walk.backbone, options, {}, 2);
  EXPECT_LE(pairs.size(), 2 * 200U);
  EXPECT_GT(pairs.size(), 100U);
}

std::size_t pairs_between_passes(const std::vector<PoseConstraint>& pairs) {
  return static_cast<std::size_t>(
      std::count_if(pairs.begin(), pairs.end(), [](const PoseConstraint& c) {
        return std::max(c.from, c.to) - std::min(c.from, c.to) > 15;
      }));
}

/// Else the last solution of a long drive would open its loops again.
TEST(RegisterPairs, HoldsPassesTogetherHoweverFewPairsAreAffordable) {
  const Walk walk;
  JointOptions options;
  options.most_pairs = 40;
  const auto pairs = register_pairs(walk.keyframes, walk.poses, walk.backbone, options, {}, 1);
  EXPECT_LE(pairs.size(), 4 * 40U);
  EXPECT_GT(pairs_between_passes(pairs), 20U);
}

TEST(RegisterPairs, LooksAtNoMoreThanItIsAllowed) {
  const Walk walk;
  JointOptions options;
  options.most_looks = 3;
  const auto few = register_pairs(walk.keyframes, walk.poses, walk.backbone, options, {}, 1);
  const auto all = register_pairs(walk.keyframes, walk.poses, walk.backbone, {}, {}, 1);
  EXPECT_GT(pairs_between_passes(few), 20U);
  EXPECT_LT(few.size(), all.size());
}

}  // namespace
}  // namespace adit
