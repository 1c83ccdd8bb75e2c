#include "adit/survey/loop_search.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace adit {
namespace {

/// Keyframes a metre apart along a way that comes back beside itself; nothing is seen.
struct Chain {
  std::vector<Keyframe> keyframes;
  std::vector<Pose2> poses;

  explicit Chain(std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) {
      Keyframe k;
      const bool back = i >= count / 2;
      k.pose = {static_cast<double>(back ? count - 1 - i : i), back ? 1.0 : 0.0, 0.0};
      if (i > 0) {
        k.previous_from_this = inverse(keyframes.back().pose) * k.pose;
        k.odometry = k.previous_from_this;
        k.tracked_information.diagonal() << 1e4, 1e4, 1e6;
        k.odometry_covariance.diagonal() << 0.01, 0.01, 0.01;
      }
      poses.push_back(k.pose);
      keyframes.push_back(k);
    }
  }
};

/// A closure that finds the map displaced by `off`.
Closure closure(const Chain& chain, std::size_t from, std::size_t to, const Vector2d& off) {
  const Pose2 seen{chain.poses[to].x + off.x(), chain.poses[to].y + off.y(), 0.0};
  Closure c;
  c.from = from;
  c.to = to;
  c.from_to = inverse(chain.poses[from]) * seen;
  c.information.diagonal() << 400.0, 400.0, 1e4;
  return c;
}

std::vector<PoseConstraint> constraints_of(const Chain& chain) {
  std::vector<PoseConstraint> out;
  for (std::size_t i = 1; i < chain.keyframes.size(); ++i) {
    out.push_back({i - 1, i, chain.keyframes[i].previous_from_this,
                   chain.keyframes[i].tracked_information, 0.0});
  }
  return out;
}

class ConsistentSet : public testing::Test {
 protected:
  ConsistentSet() : chain_(60), drift_(60, constraints_of(chain_)) {}
  std::vector<Closure> accepted(const std::vector<Closure>& candidates,
                                const std::vector<Closure>& known = {}) const {
    const LoopScene scene{chain_.keyframes, chain_.poses, drift_, 2.0};
    return consistent_set(scene, candidates, known, LoopOptions{});
  }
  Chain chain_;
  DriftBound drift_;
};

TEST_F(ConsistentSet, RefusesAClosureThatStandsAlone) {
  EXPECT_TRUE(accepted({closure(chain_, 10, 49, {0.3, 0.0})}).empty());
}

TEST_F(ConsistentSet, BelievesThoseThatAgree) {
  const Vector2d drift(0.4, -0.2);
  const auto set = accepted({closure(chain_, 10, 49, drift), closure(chain_, 8, 51, drift),
                             closure(chain_, 6, 53, drift)});
  EXPECT_EQ(set.size(), 3U);
}

TEST_F(ConsistentSet, RefusesTheOneThatContradictsThem) {
  const Vector2d drift(0.4, -0.2);
  const auto set = accepted({closure(chain_, 9, 50, {4.4, -0.2}), closure(chain_, 10, 49, drift),
                             closure(chain_, 8, 51, drift), closure(chain_, 6, 53, drift)});
  ASSERT_EQ(set.size(), 3U);
  for (const Closure& c : set) EXPECT_NE(c.from, 9U);
}

TEST_F(ConsistentSet, RefusesThoseOfWhichNoTwoAgree) {
  EXPECT_TRUE(accepted({closure(chain_, 10, 49, {0.4, 0.0}), closure(chain_, 8, 51, {-1.5, 0.0}),
                        closure(chain_, 6, 53, {3.0, 0.0})})
                  .empty());
}

/// However many agree among themselves.
TEST_F(ConsistentSet, RefusesThoseThatContradictOneAcceptedBefore) {
  const Vector2d drift(0.4, -0.2);
  const Vector2d other(3.4, -0.2);
  const std::vector<Closure> candidates = {
      closure(chain_, 10, 49, other), closure(chain_, 8, 51, other), closure(chain_, 6, 53, other)};
  EXPECT_EQ(accepted(candidates).size(), 3U);
  EXPECT_TRUE(accepted(candidates, {closure(chain_, 9, 50, drift)}).empty());
}

TEST_F(ConsistentSet, ThoseAcceptedBeforeSupport) {
  const Vector2d drift(0.4, -0.2);
  const auto set = accepted({closure(chain_, 10, 49, drift)},
                            {closure(chain_, 9, 50, drift), closure(chain_, 7, 52, drift)});
  EXPECT_EQ(set.size(), 1U);
}

/// The one in the middle agrees with both others, which are too far apart to tell of each other.
TEST(ConsistentSetOfARow, IsNotHeldUpByThoseThatAreThemselvesUnsupported) {
  const Chain chain(140);
  const DriftBound drift(140, constraints_of(chain));
  const LoopScene scene{chain.keyframes, chain.poses, drift, 2.0};
  const Vector2d off(0.1, 0.0);
  const std::vector<Closure> row = {closure(chain, 10, 129, off), closure(chain, 30, 109, off),
                                    closure(chain, 50, 89, off)};
  EXPECT_TRUE(consistent_set(scene, row, {}, LoopOptions{}).empty());
  LoopOptions one;
  one.least_support = 1;
  EXPECT_EQ(consistent_set(scene, row, {}, one).size(), 3U);
}

/// Of all nodes against one, up to a limit (m).
std::vector<RelativeSigma> sigmas_from(std::size_t source, const DriftBound& bound,
                                       const Chain& chain, double limit_m) {
  std::vector<RelativeSigma> out(chain.poses.size());
  DriftSearch search(bound, chain.poses);
  search.begin(source);
  while (const auto reached = search.next(limit_m)) out[reached->node] = reached->sigma;
  return out;
}

TEST(DriftBound, GrowsAlongTheWayAndShrinksAcrossAClosure) {
  const Chain chain(60);
  std::vector<PoseConstraint> constraints = constraints_of(chain);
  const DriftBound open(60, constraints);
  const auto before = sigmas_from(0, open, chain, 100.0);
  EXPECT_DOUBLE_EQ(before[0].metres, 0.0);
  EXPECT_GT(before[59].metres, before[30].metres);
  constraints.push_back({0, 59, inverse(chain.poses[0]) * chain.poses[59],
                         Vector3d(1e4, 1e4, 1e6).asDiagonal(), 0.0});
  const auto after = sigmas_from(0, DriftBound(60, constraints), chain, 100.0);
  EXPECT_LT(after[59].metres, 0.1 * before[59].metres);
}

TEST(DriftBound, KnowsNothingBeyondItsLimit) {
  const Chain chain(60);
  const auto sigmas = sigmas_from(0, DriftBound(60, constraints_of(chain)), chain, 0.05);
  EXPECT_TRUE(sigmas[1].known);
  EXPECT_FALSE(sigmas[59].known);
}

TEST(DriftSearch, MayBeAskedOfOneNodeAfterAnother) {
  const Chain chain(60);
  const DriftBound bound(60, constraints_of(chain));
  DriftSearch search(bound, chain.poses);
  for (const std::size_t source : {5UL, 40UL, 5UL}) {
    const auto expected = sigmas_from(source, bound, chain, 0.2);
    search.begin(source);
    std::size_t count = 0;
    while (const auto reached = search.next(0.2)) {
      EXPECT_EQ(reached->sigma.metres, expected[reached->node].metres);
      ++count;
    }
    EXPECT_EQ(count, static_cast<std::size_t>(
                         std::count_if(expected.begin(), expected.end(),
                                       [](const RelativeSigma& s) { return s.known; })));
    EXPECT_GT(count, 10U);
  }
}

}  // namespace
}  // namespace adit
