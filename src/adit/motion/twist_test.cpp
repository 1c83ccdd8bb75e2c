#include "adit/motion/twist.hpp"

#include <gtest/gtest.h>

#include <random>

namespace adit {
namespace {

void expect_near(const Pose2& a, const Pose2& b, double tolerance) {
  EXPECT_NEAR(a.x, b.x, tolerance);
  EXPECT_NEAR(a.y, b.y, tolerance);
  EXPECT_NEAR(angle_between(a.theta, b.theta), 0.0, tolerance);
}

/// Twists of all sizes of turn, none among them.
std::vector<Twist2> twists() {
  std::mt19937_64 random(3);
  std::normal_distribution<double> normal;
  std::vector<Twist2> all;
  for (const double turn_rate : {0.0, 1e-300, 1e-16, 1e-12, 1e-8, 1e-5, 1e-3, 0.1, 1.0, 3.0}) {
    for (const double sign : {-1.0, 1.0}) {
      all.push_back({3.0 * normal(random), 3.0 * normal(random), sign * turn_rate});
    }
  }
  return all;
}

TEST(Twist, AQuarterOfACircleEndsWhereGeometrySays) {
  // 2 m/s and 0.5 rad/s to the left: a circle of 4 m radius round (0, 4).
  expect_near(moved({2.0, 0.0, 0.5}, kPi), {4.0, 4.0, kPi / 2}, 1e-12);
  expect_near(moved({2.0, 0.0, 0.5}, -kPi), {-4.0, 4.0, -kPi / 2}, 1e-12);
  expect_near(moved({0.0, 2.0, 0.5}, kPi), {-4.0, 4.0, kPi / 2}, 1e-12);
  expect_near(moved({2.0, -1.0, 0.0}, 3.0), {6.0, -3.0, 0.0}, 1e-12);
  expect_near(moved({2.0, -1.0, 0.7}, 0.0), {}, 0.0);
}

TEST(Twist, AgreesWithManySmallSteps) {
  for (const Twist2& twist : twists()) {
    const int steps = 20000;
    const double dt = 0.5 / steps;
    Pose2 pose;
    for (int i = 0; i < steps; ++i) {
      pose = pose * Pose2{twist.vx * dt, twist.vy * dt, twist.omega * dt};
    }
    expect_near(moved(twist, 0.5), pose, 5e-4);
  }
}

TEST(Twist, MotionsOfOneTwistAddUp) {
  for (const Twist2& twist : twists()) {
    expect_near(moved(twist, 0.4) * moved(twist, 0.9), moved(twist, 1.3), 1e-14);
    expect_near(moved(twist, 0.8) * moved(twist, -0.8), {}, 1e-14);
  }
}

TEST(Twist, IsFoundAgainFromItsMove) {
  for (const Twist2& twist : twists()) {
    for (const double seconds : {-0.9, 1e-3, 0.2, 1.0}) {
      const Twist2 found = twist_between(moved(twist, seconds), seconds);
      EXPECT_LT((found.vector() - twist.vector()).norm(), 1e-12) << twist.vector().transpose();
    }
  }
}

TEST(Twist, EveryMoveHasATwist) {
  std::mt19937_64 random(8);
  std::uniform_real_distribution<double> metres(-2.0, 2.0);
  std::uniform_real_distribution<double> angle(-kPi, kPi);
  for (int i = 0; i < 1000; ++i) {
    const Pose2 move{metres(random), metres(random), i == 0 ? kPi : angle(random)};
    expect_near(moved(twist_between(move, 0.3), 0.3), move, 1e-12);
  }
}

TEST(Twist, AMountedFrameFeelsTheSameMotion) {
  const Pose2 vehicle_from_laser{1.3, -0.6, 2.2};
  for (const Twist2& twist : twists()) {
    const Twist2 of_laser = twist_of_mounted(twist, vehicle_from_laser);
    expect_near(vehicle_from_laser * moved(of_laser, 0.7), moved(twist, 0.7) * vehicle_from_laser,
                1e-13);
  }
}

}  // namespace
}  // namespace adit
