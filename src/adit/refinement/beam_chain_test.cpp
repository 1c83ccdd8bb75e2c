#include "adit/refinement/beam_chain.hpp"

#include <gtest/gtest.h>

#include "adit/simulation/random.hpp"

namespace adit {
namespace {

BeamPriors drawn(Random& random) {
  BeamPriors priors;
  priors.leave_ratio = random.uniform(0.001, 0.999);
  priors.back_ratio = random.uniform(0.001, 0.999);
  priors.gone_ratio = random.uniform(0.001, 0.999);
  return priors;
}

TEST(BeamChain, IsProperForAnyPriors) {
  Random random(1);
  for (int i = 0; i < 200; ++i) {
    const Matrix3d step = transition(drawn(random));
    EXPECT_GE(step.minCoeff(), 0.0);
    EXPECT_LT((step.rowwise().sum() - Vector3d::Ones()).norm(), 1e-12);
  }
}

TEST(BeamChain, HandWorkedRows) {
  const Matrix3d step =
      transition({.leave_ratio = 0.2, .back_ratio = 0.4, .long_ratio = 0.1, .gone_ratio = 0.5});
  Matrix3d expected;
  expected << 0.4, 0.1, 0.5,  //
      0.2, 0.3, 0.5,          //
      0.2, 0.5, 0.3;
  EXPECT_LT((step - expected).norm(), 1e-12);
}

TEST(BeamChain, StepsOfSeveralBeamsAreSoManyStepsOfOne) {
  Random random(2);
  const BeamPriors priors = drawn(random);
  const Matrix3d one = transition(priors);
  EXPECT_LT((transition(priors, 3) - one * one * one).norm(), 1e-12);
  EXPECT_EQ(transition(priors, 1), one);
}

TEST(BeamChain, TheSteadyStateStays) {
  Random random(3);
  for (int i = 0; i < 200; ++i) {
    const BeamPriors priors = drawn(random);
    const Vector3d state = steady_state(priors);
    EXPECT_GE(state.minCoeff(), 0.0);
    EXPECT_NEAR(state.sum(), 1.0, 1e-12);
    EXPECT_LT((transition(priors).transpose() * state - state).norm(), 1e-12);
  }
}

/// Where no wall is gone nothing but wall and clutter are left.
TEST(BeamChain, WithoutGoneWallsItHasTwoClasses) {
  BeamPriors priors{.leave_ratio = 0.03, .back_ratio = 0.1};
  priors.gone_ratio = 0.0;
  const Vector3d state = steady_state(priors);
  EXPECT_NEAR(state[Met::kWall], 0.1 / 0.13, 1e-12);
  EXPECT_NEAR(state[Met::kBeyond], 0.0, 1e-12);
  EXPECT_EQ(transition(priors)(Met::kWall, Met::kBeyond), 0.0);
}

}  // namespace
}  // namespace adit
