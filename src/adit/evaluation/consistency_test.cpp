#include "adit/evaluation/consistency.hpp"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <random>
#include <vector>

#include "support/draws.hpp"

namespace adit {
namespace {

constexpr double kInfinite = std::numeric_limits<double>::infinity();

Matrix3d diagonal(double xx, double yy, double tt) { return Vector3d(xx, yy, tt).asDiagonal(); }

Matrix3d correlated() {
  Matrix3d root;
  root << 0.3, 0.0, 0.0, 0.2, 0.1, 0.0, -0.01, 0.02, 0.004;
  return root * root.transpose();
}

TEST(Consistency, HandComputed) {
  const std::vector<ClaimedError> rows = {
      {{2.0, 0.0, 0.1}, diagonal(1.0, 1.0, 0.01)},   // 4 + 0 + 1 = 5
      {{0.0, 3.0, -0.1}, diagonal(4.0, 1.0, 0.01)},  // 0 + 9 + 1 = 10: outside
  };
  const ConsistencyFigures c = judge_consistency(rows);
  EXPECT_EQ(c.count, 2);
  EXPECT_EQ(c.partial, 0);
  EXPECT_DOUBLE_EQ(c.per_dof, 15.0 / 6.0);
  EXPECT_DOUBLE_EQ(c.coverage_95, 0.5);
  EXPECT_DOUBLE_EQ(c.axis_coverage_95.x(), 0.5);  // 2 sigma lies outside 1.96
  EXPECT_DOUBLE_EQ(c.axis_coverage_95.y(), 0.5);
  EXPECT_DOUBLE_EQ(c.axis_coverage_95.z(), 1.0);
  const double logs = 3.0 * std::log(kTwoPi);
  const double first = -0.5 * (5.0 + std::log(0.01) + logs);
  const double second = -0.5 * (10.0 + std::log(0.04) + logs);
  EXPECT_NEAR(c.mean_log_likelihood, 0.5 * (first + second), 1e-12);
}

TEST(Consistency, HonestClaimsGiveOne) {
  const Matrix3d covariance = correlated();
  const Matrix3d lower = covariance.llt().matrixL();
  std::mt19937_64 random(5);
  std::normal_distribution<double> normal;
  std::vector<ClaimedError> rows;
  for (int i = 0; i < 20000; ++i) {
    const Vector3d white = test::drawn<3>([&] { return normal(random); });
    rows.push_back({lower * white, covariance});
  }
  const ConsistencyFigures honest = judge_consistency(rows);
  EXPECT_NEAR(honest.per_dof, 1.0, 0.025);  // four sigma: sqrt(2 / 60000) = 0.0058
  EXPECT_NEAR(honest.coverage_95, 0.95, 0.0065);
  for (int axis = 0; axis < 3; ++axis) EXPECT_NEAR(honest.axis_coverage_95(axis), 0.95, 0.0065);

  for (ClaimedError& row : rows) row.covariance /= 4.0;
  const ConsistencyFigures boastful = judge_consistency(rows);
  EXPECT_NEAR(boastful.per_dof, 4.0 * honest.per_dof, 1e-9);
  EXPECT_LT(boastful.coverage_95, 0.7);
  // No other claim explains the errors better than the true one.
  EXPECT_LT(boastful.mean_log_likelihood, honest.mean_log_likelihood);
  for (ClaimedError& row : rows) row.covariance *= 16.0;
  EXPECT_LT(judge_consistency(rows).mean_log_likelihood, honest.mean_log_likelihood);
}

TEST(Consistency, UnknownAxesAreLeftToTheOthers) {
  Matrix3d no_x = correlated();
  no_x(0, 0) = kInfinite;
  no_x(0, 1) = no_x(1, 0) = std::numeric_limits<double>::quiet_NaN();
  Matrix3d only_heading = diagonal(kInfinite, kInfinite, 0.04);
  const Vector3d error(77.0, 0.1, 0.3);
  const Matrix2d marginal = correlated().bottomRightCorner<2, 2>();
  const double two = error.tail<2>().dot(marginal.inverse() * error.tail<2>());
  const double one = 0.3 * 0.3 / 0.04;

  const std::vector<ClaimedError> rows = {
      {error, no_x}, {error, only_heading}, {error, diagonal(kInfinite, kInfinite, kInfinite)}};
  const ConsistencyFigures c = judge_consistency(rows);
  EXPECT_EQ(c.count, 2);
  EXPECT_EQ(c.partial, 2);
  EXPECT_EQ(c.unknown, 1);
  EXPECT_EQ(c.invalid, 0);
  EXPECT_NEAR(c.per_dof, (two + one) / 3.0, 1e-9 * (two + one));
  EXPECT_TRUE(std::isnan(c.mean_log_likelihood));
  EXPECT_TRUE(std::isnan(c.axis_coverage_95.x()));
}

TEST(Consistency, WhatIsNoCovarianceIsCountedApart) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  Matrix3d indefinite = diagonal(1.0, 1.0, 1.0);
  indefinite(0, 1) = indefinite(1, 0) = 2.0;
  Matrix3d rank_one = Vector3d(1.0, 2.0, 3.0) * Vector3d(1.0, 2.0, 3.0).transpose();
  const std::vector<ClaimedError> rows = {{Vector3d::Zero(), Matrix3d::Zero()},
                                          {Vector3d::Zero(), diagonal(1.0, -1.0, 1.0)},
                                          {Vector3d::Zero(), diagonal(1.0, nan, 1.0)},
                                          {Vector3d::Zero(), diagonal(1.0, -kInfinite, 1.0)},
                                          {Vector3d::Zero(), indefinite},
                                          {Vector3d::Zero(), rank_one}};
  const ConsistencyFigures c = judge_consistency(rows);
  EXPECT_EQ(c.invalid, 6);
  EXPECT_EQ(c.count, 0);
  EXPECT_TRUE(std::isnan(c.per_dof));
  EXPECT_TRUE(std::isnan(c.coverage_95));
}

TEST(Consistency, ScaleOfTheUnitsDoesNotMakeItSingular) {
  const std::vector<ClaimedError> rows = {{{1e-9, 1e9, 0.0}, diagonal(1e-18, 1e18, 1.0)}};
  const ConsistencyFigures c = judge_consistency(rows);
  EXPECT_EQ(c.count, 1);
  EXPECT_NEAR(c.per_dof, 2.0 / 3.0, 1e-12);
}

TEST(Consistency, AnErrorWithoutNumberIsInfinite) {
  const std::vector<ClaimedError> rows = {{Vector3d::Constant(kInfinite), diagonal(1.0, 1.0, 1.0)}};
  const ConsistencyFigures c = judge_consistency(rows);
  EXPECT_EQ(c.per_dof, kInfinite);
  EXPECT_EQ(c.coverage_95, 0.0);
}

TEST(Consistency, NoRows) { EXPECT_EQ(judge_consistency({}).count, 0); }

}  // namespace
}  // namespace adit
