#include "adit/refinement/offset_process.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace adit {
namespace {

constexpr double kTurn = 0.3;

double shared(double metres, double turn) {
  const OffsetProcess process{0.04, 1.5};
  const Vector2d normal = unit_vector(0.2);
  return process.correlation({3.0, 1.0}, normal, Vector2d(3.0, 1.0) + metres * Vector2d::UnitX(),
                             unit_vector(0.2 + turn));
}

TEST(OffsetProcess, FallsOffAlongAWall) {
  EXPECT_DOUBLE_EQ(shared(0.0, 0.0), 1.0);
  EXPECT_NEAR(shared(1.5, 0.0), 1.0 / 2.5, 1e-12);
  EXPECT_NEAR(shared(3.0, 0.0), 1.0 / 5.0, 1e-12);
  for (double metres = 0.0; metres < 0.5; metres += 0.05) {
    EXPECT_NEAR(shared(metres, 0.0), std::exp(-metres / 1.5), 0.006) << metres;
  }
}

TEST(OffsetProcess, IsSharedRoundABendButNotRoundACorner) {
  EXPECT_NEAR(shared(0.0, kTurn), std::cos(kTurn), 1e-12);
  EXPECT_NEAR(shared(0.0, 0.5 * kPi), 0.0, 1e-12);
}

/// Both sides of a pillar or of a thin wall: their offsets have nothing to do with each other.
TEST(OffsetProcess, SidesThatFaceAwayShareNothing) { EXPECT_EQ(shared(0.2, kPi), 0.0); }

TEST(OffsetProcess, WhatIsKnownFadesToTheProcess) {
  const OffsetProcess process{0.04, 1.5};
  EXPECT_DOUBLE_EQ(process.carried(0.01, 1.0), 0.01);
  EXPECT_DOUBLE_EQ(process.carried(0.01, 0.0), 0.04);
  EXPECT_DOUBLE_EQ(process.carried(0.04, 0.3), 0.04);
  EXPECT_NEAR(process.carried(0.0, 0.5), 0.03, 1e-15);
}

TEST(OffsetProcess, OfAMapErrorIsThePartThatNeighboursShare) {
  const OffsetProcess process = offset_process({0.2, 3.0, 0.5});
  EXPECT_DOUBLE_EQ(process.variance, 0.04);
  EXPECT_DOUBLE_EQ(process.length_m, 3.0);
}

}  // namespace
}  // namespace adit
