#include "adit/evaluation/bound_summary.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "support/draws.hpp"

namespace adit {
namespace {

TEST(MeanErrorLength, KnownCases) {
  // One direction only: the half-normal mean. Both alike: the Rayleigh mean.
  EXPECT_NEAR(mean_error_length(Vector2d(4.0, 0.0).asDiagonal()), 2.0 * std::sqrt(2.0 / kPi),
              1e-12);
  EXPECT_NEAR(mean_error_length(4.0 * Matrix2d::Identity()), 2.0 * std::sqrt(kPi / 2.0), 1e-12);
  EXPECT_EQ(mean_error_length(Matrix2d::Zero()), 0.0);
}

TEST(MeanErrorLength, AgreesWithSampling) {
  Matrix2d root;
  root << 0.5, 0.0, 0.8, 0.2;
  std::mt19937_64 random(2);
  std::normal_distribution<double> normal;
  constexpr int kSamples = 100000;
  double sum = 0.0;
  for (int i = 0; i < kSamples; ++i) {
    sum += (root * test::drawn<2>([&] { return normal(random); })).norm();
  }
  EXPECT_NEAR(mean_error_length(root * root.transpose()), sum / kSamples, 0.01);
}

TEST(BoundAlong, AveragesOverTheObservablePoses) {
  const std::vector<Segment> square = {
      {{0, 0}, {6, 0}}, {{6, 0}, {6, 6}}, {{6, 6}, {0, 6}}, {{0, 6}, {0, 0}}};
  const LineMap map = LineMap::build(square);
  const ScannerModel scanner;
  const std::vector<StampedPose> poses = {{0, {2, 3, 0}}, {1, {3, 4, 1}}, {2, {500, 500, 0}}};
  const BoundSummary summary = bound_along(map, poses, scanner, {});
  EXPECT_EQ(summary.count, 2);
  EXPECT_EQ(summary.unobservable, 1);

  BoundWorkspace workspace;
  double squares = 0.0;
  double heading = 0.0;
  for (int i = 0; i < 2; ++i) {
    const PoseBound bound =
        cramer_rao(map, poses[static_cast<std::size_t>(i)].pose, scanner, {}, {}, workspace);
    ASSERT_TRUE(bound.covariance);
    squares += (*bound.covariance)(0, 0) + (*bound.covariance)(1, 1);
    heading += std::sqrt((*bound.covariance)(2, 2));
  }
  EXPECT_NEAR(summary.position_rms, std::sqrt(squares / 2.0), 1e-12);
  EXPECT_NEAR(summary.heading_mean_deg, degrees(heading / 2.0 * std::sqrt(2.0 / kPi)), 1e-12);
  EXPECT_LT(summary.position_mean, summary.position_rms);
  EXPECT_GT(summary.position_mean, 0.8 * summary.position_rms);
}

TEST(BoundAlong, NothingSeenIsNotANumber) {
  const std::vector<StampedPose> poses = {{0, {0, 0, 0}}};
  const BoundSummary summary = bound_along(LineMap::build({}), poses, {}, {});
  EXPECT_EQ(summary.count, 0);
  EXPECT_EQ(summary.unobservable, 1);
  EXPECT_TRUE(std::isnan(summary.position_rms));
}

}  // namespace
}  // namespace adit
