#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <Eigen/LU>
#include <random>

#include "adit/geometry/moments.hpp"
#include "adit/geometry/pose2.hpp"
#include "adit/geometry/result.hpp"
#include "adit/geometry/segment.hpp"
#include "adit/geometry/uncertain_move.hpp"

namespace adit {
namespace {

double metres() { return *rc::gen::inRange(-100000, 100000) * 1e-3; }
double angle() { return *rc::gen::inRange(-31415, 31416) * 1e-4; }
Pose2 any_pose() { return {metres(), metres(), angle()}; }

bool near(const Pose2& a, const Pose2& b, double tolerance = 1e-9) {
  return std::abs(a.x - b.x) < tolerance && std::abs(a.y - b.y) < tolerance &&
         std::abs(angle_between(a.theta, b.theta)) < tolerance;
}

RC_GTEST_PROP(Pose2, CompositionIsAssociative, ()) {
  const Pose2 a = any_pose(), b = any_pose(), c = any_pose();
  RC_ASSERT(near((a * b) * c, a * (b * c), 1e-8));
}

RC_GTEST_PROP(Pose2, InverseUndoes, ()) {
  const Pose2 a = any_pose();
  RC_ASSERT(near(a * inverse(a), Pose2{}));
  RC_ASSERT(near(inverse(a) * a, Pose2{}));
  RC_ASSERT(near(a * Pose2{}, a));
}

RC_GTEST_PROP(Pose2, CarriesPointsLikeItComposes, ()) {
  const Pose2 a = any_pose(), b = any_pose();
  const Vector2d p(metres(), metres());
  RC_ASSERT(((a * b) * p - a * (b * p)).norm() < 1e-8);
  RC_ASSERT((RigidTransform(a).point(p) - a * p).norm() < 1e-9);
}

RC_GTEST_PROP(Angle, WrappingKeepsTheDirection, ()) {
  const double wild = *rc::gen::inRange(-1000000, 1000000) * 1e-3;
  const double wrapped = wrap_angle(wild);
  RC_ASSERT(wrapped > -kPi && wrapped <= kPi);
  RC_ASSERT((unit_vector(wild) - unit_vector(wrapped)).norm() < 1e-9);
  const double positive = wrap_positive(wild);
  RC_ASSERT(positive >= 0.0 && positive < kTwoPi);
  RC_ASSERT((unit_vector(wild) - unit_vector(positive)).norm() < 1e-9);
}

TEST(Angle, WrapsTheSeamToPlusPi) {
  EXPECT_DOUBLE_EQ(wrap_angle(kPi), kPi);
  EXPECT_DOUBLE_EQ(wrap_angle(-kPi), kPi);
  EXPECT_DOUBLE_EQ(wrap_angle(3 * kPi), kPi);
  EXPECT_DOUBLE_EQ(degrees(radians(30.0)), 30.0);
  EXPECT_TRUE(std::isnan(wrap_angle(std::nan(""))));
  EXPECT_TRUE(std::isnan(wrap_angle(INFINITY)));
  EXPECT_TRUE(std::isnan(wrap_positive(std::nan(""))));
}

TEST(PoseWithCovariance, TheLeverArmCarriesHeadingErrorsIntoPosition) {
  // Against sampling: poses drawn from the covariance, each carried exactly.
  PoseWithCovariance vehicle{{1.0, 2.0, 0.8}, Matrix3d::Zero()};
  vehicle.covariance.diagonal() << 1e-4, 4e-4, 1e-6;
  const Pose2 mount{3.0, -1.0, 0.4};
  const PoseWithCovariance laser = carry(vehicle, mount);
  EXPECT_TRUE(near(laser.pose, vehicle.pose * mount));

  std::mt19937_64 random(1);
  std::normal_distribution<double> normal;
  Matrix3d sampled = Matrix3d::Zero();
  const int count = 20000;
  for (int i = 0; i < count; ++i) {
    Pose2 drawn = vehicle.pose;
    drawn.x += 1e-2 * normal(random);
    drawn.y += 2e-2 * normal(random);
    drawn.theta += 1e-3 * normal(random);
    const Vector3d error = (drawn * mount).vector() - laser.pose.vector();
    sampled += error * error.transpose() / count;
  }
  EXPECT_LT((sampled - laser.covariance).norm(), 0.05 * laser.covariance.norm());
  const PoseWithCovariance back = carry(laser, inverse(mount));
  EXPECT_TRUE(near(back.pose, vehicle.pose));
  EXPECT_TRUE(back.covariance.isApprox(vehicle.covariance, 1e-9));
}

TEST(UncertainMove, TheWayBackErrsAsDrawnMovesDo) {
  Matrix3d root;
  root << 0.02, 0.0, 0.0, 0.01, 0.03, 0.0, -0.004, 0.002, 0.005;
  const PoseWithCovariance move{{3.0, -1.5, 0.8}, root * root.transpose()};
  const PoseWithCovariance back = inverse(move);
  EXPECT_TRUE(near(back.pose, inverse(move.pose)));
  std::mt19937_64 random(7);
  std::normal_distribution<double> normal;
  Matrix3d drawn = Matrix3d::Zero();
  constexpr int kDraws = 20000;
  for (int i = 0; i < kDraws; ++i) {
    const Vector3d error = root * Vector3d(normal(random), normal(random), normal(random));
    const Pose2 real = Pose2::from_vector(move.pose.vector() + error);
    const Vector3d off = difference(back.pose, inverse(real));
    drawn += off * off.transpose() / kDraws;
  }
  EXPECT_LT((drawn - back.covariance).norm(), 0.03 * back.covariance.norm());
  EXPECT_LT((inverse(back).covariance - move.covariance).norm(), 1e-12);
}

TEST(UncertainMove, ThereAndBackLeavesTheErrorsOfAllThree) {
  const auto diagonal = [](double x, double y, double theta) {
    return Matrix3d(Vector3d(x, y, theta).asDiagonal());
  };
  const PoseWithCovariance start{{1.0, 2.0, 0.3}, diagonal(0.01, 0.02, 1e-4)};
  const PoseWithCovariance move{{4.0, 1.0, -0.5}, diagonal(0.03, 0.01, 2e-4)};
  const PoseWithCovariance back = moved_by(moved_by(start, move), inverse(move));
  EXPECT_TRUE(near(back.pose, start.pose));
  // Two moves, there and back, of which each swings where it ends about where it began: seen from
  // the start both act through the lever of the way back.
  const Vector2d lever = RigidTransform(start.pose).direction(-move.pose.translation());
  Matrix3d swing = Matrix3d::Identity();
  swing.topRightCorner<2, 1>() = perpendicular(lever);
  const Matrix3d once = swing * turned(move.covariance, start.pose.theta) * swing.transpose();
  EXPECT_LT((back.covariance - start.covariance - 2.0 * once).norm(), 1e-12);
}

TEST(Segment, NearestPointAndDistance) {
  const Segment s{{0, 0}, {4, 0}};
  EXPECT_DOUBLE_EQ(distance(s, {2, 3}), 3.0);
  EXPECT_DOUBLE_EQ(distance(s, {-3, 4}), 5.0);
  EXPECT_DOUBLE_EQ(distance(s, {7, -4}), 5.0);
  EXPECT_DOUBLE_EQ(distance({{1, 1}, {1, 1}}, {1, 3}), 2.0);
  EXPECT_FALSE((Segment{{0, std::nan("")}, {1, 1}}).is_finite());
}

TEST(Moments, SlidingAndSplittingAgreeWithTheWhole) {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> uniform(-50, 50);
  Moments whole, left, right;
  for (int i = 0; i < 40; ++i) {
    const double x = uniform(random), y = uniform(random);
    whole.add(x, y);
    (i < 15 ? left : right).add(x, y);
  }
  const LineFit direct = fit_line(whole);
  EXPECT_NEAR(fit_line(left + right).squared_error, direct.squared_error, 1e-7);
  EXPECT_NEAR(fit_line(whole - left).squared_error, fit_line(right).squared_error, 1e-7);
}

TEST(Moments, FitIsTheLeastOfAllLines) {
  std::mt19937_64 random(4);
  std::normal_distribution<double> normal;
  std::vector<Vector2d> points;
  Moments moments;
  for (int i = 0; i < 30; ++i) {
    points.emplace_back(0.5 * i + 3, 0.2 * i - 7 + 0.1 * normal(random));
    moments.add(points.back().x(), points.back().y());
  }
  const LineFit fit = fit_line(moments);
  const auto squared_error = [&](double turn, double shift) {
    const Vector2d direction = unit_vector(std::atan2(fit.direction.y(), fit.direction.x()) + turn);
    double sum = 0.0;
    for (const Vector2d& p : points) {
      const double d = cross(direction, p - fit.centroid) + shift;
      sum += d * d;
    }
    return sum;
  };
  EXPECT_NEAR(squared_error(0, 0), fit.squared_error, 1e-8);
  for (const double turn : {-0.01, 0.01}) EXPECT_GT(squared_error(turn, 0), fit.squared_error);
  for (const double shift : {-0.01, 0.01}) EXPECT_GT(squared_error(0, shift), fit.squared_error);
}

TEST(Error, NamesFileAndLineWhereKnown) {
  EXPECT_EQ(to_string(Error{"expected four numbers", "plan.csv", 7}),
            "plan.csv:7: expected four numbers");
  EXPECT_EQ(to_string(Error{"is empty", "plan.csv", 0}), "plan.csv: is empty");
  EXPECT_EQ(to_string(Error{"no", "", 0}), "no");
}

TEST(Pose2, AreNearWithinBothBounds) {
  const Pose2 pose{1.0, 2.0, radians(179.0)};
  const Pose2 other{1.3, 2.4, radians(-179.0)};  // 0.5 m off, turned by two degrees across pi
  EXPECT_TRUE(is_near(pose, other, 0.51, radians(2.1)));
  EXPECT_FALSE(is_near(pose, other, 0.49, radians(2.1)));
  EXPECT_FALSE(is_near(pose, other, 0.51, radians(1.9)));
  EXPECT_TRUE(is_near(pose, pose, 0.0, 0.0));
}

}  // namespace
}  // namespace adit
