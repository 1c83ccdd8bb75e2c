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
  quality.returns = 300.0;
  quality.wall_ratio = 0.9;
  return quality;
}

FitQuality bad() {
  FitQuality quality = good();
  quality.evidence_ratio = 0.0;
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

TEST(Explains, RefusesEachFaultAlone) {
  const StatusOptions options;
  EXPECT_TRUE(explains(good(), options));
  FitQuality fit = good();
  fit.converged = false;
  EXPECT_FALSE(explains(fit, options));
  fit = good();
  fit.wall_ratio = options.least_wall_ratio - 0.01;
  EXPECT_FALSE(explains(fit, options));
  fit.wall_ratio = options.least_wall_ratio + 0.01;
  EXPECT_TRUE(explains(fit, options));
  fit = good();
  fit.behind_ratio = options.most_behind_ratio + 0.01;
  EXPECT_FALSE(explains(fit, options));
  fit.behind_ratio = options.most_behind_ratio - 0.01;
  EXPECT_TRUE(explains(fit, options));
}

/// The evidence (of the expected) from which such a fit explains its scan.
double evidence_asked(FitQuality fit, const StatusOptions& options) {
  fit.evidence_ratio = 0.0;
  while (!explains(fit, options) && fit.evidence_ratio < 2.0) fit.evidence_ratio += 1e-3;
  return fit.evidence_ratio;
}

TEST(Explains, AsksMoreWhereRockIsSeenThrough) {
  const StatusOptions options;
  FitQuality fit = good();
  EXPECT_NEAR(evidence_asked(fit, options), options.least_evidence_ratio, 2e-3);
  fit.behind_ratio = 0.05;
  EXPECT_NEAR(evidence_asked(fit, options),
              options.least_evidence_ratio + 0.05 * options.evidence_per_behind, 2e-3);
  fit.behind_ratio = options.most_behind_ratio - 0.01;
  EXPECT_NEAR(evidence_asked(fit, options), options.most_evidence_ratio, 2e-3);
}

TEST(Explains, RefusesWhatIsNoNumber) {
  for (double FitQuality::*ratio :
       {&FitQuality::evidence_ratio, &FitQuality::wall_ratio, &FitQuality::behind_ratio}) {
    FitQuality fit = good();
    fit.*ratio = kNan;
    EXPECT_FALSE(explains(fit, {}));
  }
  EXPECT_FALSE(explains({}, {}));
}

TEST(Trust, HoldsWhileScansExplainThemselves) {
  Trust trust;
  for (int i = 0; i < 10; ++i) EXPECT_TRUE(trust.next(good(), 1.0, {}));
}

TEST(Trust, AsksMoreWhereScanAndDeadReckoningDisagree) {
  const StatusOptions options;
  FitQuality fit = good();
  fit.agrees = false;
  fit.evidence_ratio = options.regain_evidence_ratio - 0.01;
  EXPECT_TRUE(explains(fit, options));
  EXPECT_FALSE(Trust{}.next(fit, 1.0, options));
  fit.evidence_ratio = options.first_evidence_ratio - options.disagreeing_drop + 0.01;
  EXPECT_TRUE(Trust{}.next(fit, 1.0, options));
}

TEST(Trust, ADisagreementWithLessThanIsUsualContradictsThePose) {
  const StatusOptions options;
  FitQuality worse = good();
  worse.evidence_ratio -= options.disagreeing_drop + 0.01;
  FitQuality slipped = good();
  slipped.agrees = false;
  FitQuality both = worse;
  both.agrees = false;
  EXPECT_GT(both.evidence_ratio, options.regain_evidence_ratio);
  Trust trust;
  for (int i = 0; i < 10; ++i) EXPECT_TRUE(trust.next(good(), 1.0, options));
  EXPECT_TRUE(trust.next(worse, 1.0, options));
  EXPECT_TRUE(trust.next(slipped, 1.0, options));
  EXPECT_FALSE(trust.next(both, 1.0, options));
}

TEST(Trust, ASuddenLookThroughRockContradictsThePose) {
  const StatusOptions options;
  FitQuality odd = good();
  odd.evidence_ratio -= options.sudden_evidence_ratio + 0.02;
  odd.behind_ratio += options.sudden_behind_ratio + 0.01;
  FitQuality hidden = odd;  // something stands in the way
  hidden.behind_ratio = good().behind_ratio;
  FitQuality open = good();  // a curtain is open
  open.behind_ratio = odd.behind_ratio;
  FitQuality odd_start = odd;
  odd_start.evidence_ratio = options.first_evidence_ratio - options.sudden_evidence_ratio - 0.01;
  odd_start.behind_ratio = options.first_behind_ratio + options.sudden_behind_ratio + 0.01;
  Trust trust;
  EXPECT_TRUE(trust.next(odd, 1.0, options));  // nobody knows yet what is usual
  EXPECT_FALSE(trust.next(odd_start, 1.0, options));
  trust.reset();
  for (int i = 0; i < 10; ++i) EXPECT_TRUE(trust.next(good(), 1.0, options));
  EXPECT_TRUE(trust.next(hidden, 1.0, options));
  EXPECT_TRUE(trust.next(open, 1.0, options));
  EXPECT_FALSE(trust.next(odd, 1.0, options));
  EXPECT_TRUE(trust.contradicted());
}

TEST(Trust, NothingHidesAThirdOfTheScanAtOnce) {
  const StatusOptions options;
  const auto trusts = [&](double drop, int scans_before) {
    Trust trust;
    for (int i = 0; i < scans_before; ++i) EXPECT_TRUE(trust.next(good(), 1.0, options));
    FitQuality hidden = good();
    hidden.evidence_ratio -= drop;
    return trust.next(hidden, 1.0, options);
  };
  EXPECT_TRUE(trusts(options.sudden_drop_ratio - 0.02, 10));
  EXPECT_FALSE(trusts(options.sudden_drop_ratio + 0.02, 10));
  EXPECT_TRUE(trusts(options.sudden_drop_ratio + 0.02, 1));  // nobody knows yet what is usual
}

/// How far (m) the vehicle must go in steps until the pose is trusted again.
double way_to_regain(Trust& trust, const FitQuality& quality, double step_m) {
  double way = step_m;
  while (!trust.next(quality, step_m, {}) && way < 100.0) way += step_m;
  return way;
}

TEST(Trust, WhatWorsensScanByScanIsNotSudden) {
  const StatusOptions options;
  Trust trust;
  FitQuality scan = good();
  for (int i = 0; i < 100; ++i) EXPECT_TRUE(trust.next(scan, 0.2, options));
  const double worst = scan.evidence_ratio - options.sudden_evidence_ratio - 0.1;
  while (scan.evidence_ratio > worst) {  // rougher walls come into sight
    scan.evidence_ratio -= 0.01;
    scan.behind_ratio += 0.002;
    EXPECT_TRUE(trust.next(scan, 0.2, options)) << scan.evidence_ratio;
  }
}

TEST(Trust, ComesBackOnlyAfterSomeWay) {
  const StatusOptions options;
  Trust trust;
  EXPECT_TRUE(trust.next(good(), 1.0, options));
  EXPECT_FALSE(trust.next(bad(), 1.0, options));
  // Standing shows the same walls again and again: it regains nothing.
  for (int i = 0; i < 100; ++i) EXPECT_FALSE(trust.next(good(), 0.0, options));
  EXPECT_NEAR(way_to_regain(trust, good(), 0.25), options.regain_way_m, 0.26);
  EXPECT_TRUE(trust.next(good(), 0.0, options));
}

TEST(Trust, ANewContradictionBeginsTheWayAnew) {
  const StatusOptions options;
  Trust trust;
  EXPECT_FALSE(trust.next(bad(), 1.0, options));
  EXPECT_FALSE(trust.next(good(), 0.8 * options.regain_way_m, options));
  EXPECT_FALSE(trust.next(bad(), 1.0, options));
  EXPECT_FALSE(trust.next(good(), 0.8 * options.regain_way_m, options));
}

/// Whether scans of which so much is explained bring the trust back.
bool regains(Trust trust, double evidence_ratio, const StatusOptions& options) {
  FitQuality quality = good();
  quality.evidence_ratio = evidence_ratio;
  trust.next(bad(), 1.0, options);
  return trust.next(quality, 2.0 * options.regain_way_m, options);
}

TEST(Trust, AsksForAsMuchAsIsUsualHere) {
  const StatusOptions options;
  for (const double usual : {0.7, 0.9}) {
    FitQuality scan = good();
    scan.evidence_ratio = usual;
    Trust trust;
    for (int i = 0; i < 10; ++i) EXPECT_TRUE(trust.next(scan, 1.0, options));
    EXPECT_FALSE(regains(trust, usual - options.regain_slack - 0.01, options));
    EXPECT_TRUE(regains(trust, usual - options.regain_slack + 0.01, options));
  }
}

TEST(Trust, AsksForTheStatedWhereNothingIsUsualYet) {
  const StatusOptions options;
  EXPECT_FALSE(regains({}, options.regain_evidence_ratio - 0.01, options));
  EXPECT_TRUE(regains({}, options.regain_evidence_ratio + 0.01, options));
}

TEST(Trust, AResetForgets) {
  Trust trust;
  trust.next(bad(), 1.0, {});
  EXPECT_TRUE(trust.contradicted());
  trust.reset();
  EXPECT_FALSE(trust.contradicted());
  EXPECT_TRUE(trust.next(good(), 0.0, {}));
}

TEST(Trust, ABlindScannerContradictsNothing) {
  const StatusOptions options;
  FitQuality blind = bad();
  blind.returns = options.fewest_returns - 1.0;
  Trust trust;
  EXPECT_TRUE(trust.next(good(), 1.0, options));
  EXPECT_FALSE(trust.next(blind, 1.0, options));
  EXPECT_TRUE(trust.next(good(), 1.0, options));
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
