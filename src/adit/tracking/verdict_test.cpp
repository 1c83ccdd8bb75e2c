#include "adit/tracking/verdict.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <string>

namespace adit {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

FitQuality good() {
  FitQuality quality;
  quality.converged = true;
  quality.evidence_ratio = 0.9;
  quality.wall_ratio = 0.9;
  quality.behind_ratio = 0.02;
  return quality;
}

/// Covariance with these sigmas along an axis (rad), across it and of the heading.
Matrix3d covariance(double along, double across, double axis, double heading) {
  Matrix2d turn;
  turn.col(0) = unit_vector(axis);
  turn.col(1) = perpendicular(unit_vector(axis));
  Matrix3d result = Matrix3d::Zero();
  const Vector2d sigmas(along, across);
  result.topLeftCorner<2, 2>() = turn * sigmas.cwiseAbs2().asDiagonal() * turn.transpose();
  result(2, 2) = heading * heading;
  return result;
}

TEST(Explains, TakesAGoodFit) {
  EXPECT_TRUE(explains(good(), false, {}));
  EXPECT_TRUE(explains(good(), true, {}));
}

TEST(Explains, AsksMoreAfterAScanThatDidNotFit) {
  const StatusOptions options;
  FitQuality between = good();
  between.evidence_ratio = 0.5 * (options.least_evidence_ratio + options.regain_evidence_ratio);
  EXPECT_TRUE(explains(between, false, options));
  EXPECT_FALSE(explains(between, true, options));
  between.evidence_ratio = options.regain_evidence_ratio + 0.01;
  EXPECT_TRUE(explains(between, true, options));
  between.evidence_ratio = options.least_evidence_ratio - 0.01;
  EXPECT_FALSE(explains(between, false, options));
}

TEST(Explains, RefusesEachFaultAlone) {
  const StatusOptions options;
  FitQuality fit = good();
  fit.converged = false;
  EXPECT_FALSE(explains(fit, false, options));
  fit = good();
  fit.wall_ratio = options.least_wall_ratio - 0.01;
  EXPECT_FALSE(explains(fit, false, options));
  fit.wall_ratio = options.least_wall_ratio + 0.01;
  EXPECT_TRUE(explains(fit, false, options));
  fit = good();
  fit.behind_ratio = options.most_behind_ratio + 0.01;
  EXPECT_FALSE(explains(fit, false, options));
  fit.behind_ratio = options.most_behind_ratio - 0.01;
  EXPECT_TRUE(explains(fit, false, options));
}

TEST(Explains, RefusesWhatIsNoNumber) {
  for (double FitQuality::*ratio :
       {&FitQuality::evidence_ratio, &FitQuality::wall_ratio, &FitQuality::behind_ratio}) {
    FitQuality fit = good();
    fit.*ratio = kNan;
    EXPECT_FALSE(explains(fit, false, {}));
  }
  EXPECT_FALSE(explains({}, false, {}));
}

TEST(OpenDirection, IsTheAxisThatTheScanDoesNotShow) {
  const StatusOptions options;
  for (double axis = -kPi; axis < kPi; axis += 0.1) {
    const auto open =
        open_direction(covariance(2.0 * options.degraded_sigma_m, 0.02, axis, 0.01), options);
    ASSERT_TRUE(open.has_value());
    EXPECT_NEAR(open->norm(), 1.0, 1e-12);
    EXPECT_NEAR(std::abs(open->dot(unit_vector(axis))), 1.0, 1e-9) << axis;
  }
}

TEST(OpenDirection, BeginsAtTheStatedSigma) {
  const StatusOptions options;
  for (double axis = -kPi; axis < kPi; axis += 0.37) {
    for (const double across : {0.0, 0.9}) {
      const double along = options.degraded_sigma_m;
      EXPECT_TRUE(open_direction(covariance(1.01 * along, across * along, axis, 0.0), options));
      EXPECT_FALSE(open_direction(covariance(0.99 * along, across * along, axis, 0.0), options));
    }
  }
}

TEST(OpenDirection, IsZeroWhereTheHeadingIsOpen) {
  const StatusOptions options;
  const auto open =
      open_direction(covariance(0.1, 0.1, 0.3, 1.01 * options.degraded_sigma_rad), options);
  ASSERT_TRUE(open.has_value());
  EXPECT_EQ(open->norm(), 0.0);
  EXPECT_FALSE(
      open_direction(covariance(0.1, 0.1, 0.3, 0.99 * options.degraded_sigma_rad), options));
  // A place that is open counts for more than an open heading.
  const auto both =
      open_direction(covariance(2.0 * options.degraded_sigma_m, 0.1, 0.3, 1.0), options);
  ASSERT_TRUE(both.has_value());
  EXPECT_NEAR(both->norm(), 1.0, 1e-12);
}

TEST(Status, HasTheNamesOfTheFiles) {
  EXPECT_EQ(to_string(Status::ok), std::string("ok"));
  EXPECT_EQ(to_string(Status::degraded), std::string("degraded"));
  EXPECT_EQ(to_string(Status::ambiguous), std::string("ambiguous"));
  EXPECT_EQ(to_string(Status::lost), std::string("lost"));
}

TEST(Estimate, ClaimsNothingBeforeTheFirstScan) {
  const Estimate estimate;
  EXPECT_EQ(estimate.status, Status::lost);
  EXPECT_TRUE(estimate.dead_reckoned);
  EXPECT_EQ(estimate.protection_m, std::numeric_limits<double>::infinity());
}

}  // namespace
}  // namespace adit
