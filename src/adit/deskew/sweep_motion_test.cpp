#include "adit/deskew/sweep_motion.hpp"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <random>

#include "support/draws.hpp"

namespace adit {
namespace {

constexpr double kSweep = 0.2;
const Twist2 kDrive{5.0, -0.3, radians(45.0)};
const OdometryNoise kNoise{0.02, 0.001, 0.02, 0.001, 0.0005};

ScannerModel scanner(SweepMoment stamp, double sweep_s = kSweep) {
  ScannerModel model;
  model.sweep_s = sweep_s;
  model.stamp = stamp;
  return model;
}

/// Dead reckoning along one circle, every so many seconds.
PoseHistory driven(double from, double to, double interval) {
  PoseHistory history;
  const int count = static_cast<int>(std::round((to - from) / interval));
  for (int i = 0; i <= count; ++i) {
    const double t = from + i * interval;
    history.add({t, Pose2{100.0, 20.0, 2.5} * moved(kDrive, t)});
  }
  return history;
}

SweepMotion motion_at(double stamp, const PoseHistory& history, const ScannerModel& model) {
  return sweep_motion(history, stamp, model, kNoise, {});
}

void expect_near(const Twist2& a, const Twist2& b, double tolerance) {
  EXPECT_NEAR(a.vx, b.vx, tolerance);
  EXPECT_NEAR(a.vy, b.vy, tolerance);
  EXPECT_NEAR(a.omega, b.omega, tolerance);
}

class Stamps : public testing::TestWithParam<SweepMoment> {};

TEST_P(Stamps, OdometryAroundTheSweepGivesItsMotionAndNoise) {
  const SweepMotion motion = motion_at(1.5, driven(0.0, 3.0, 0.02), scanner(GetParam()));
  EXPECT_TRUE(motion.known);
  expect_near(motion.twist, kDrive, 1e-9);
  const Matrix3d expected = move_covariance(moved(kDrive, kSweep), kNoise) / (kSweep * kSweep);
  // Readings may begin up to 20 ms before the sweep, and end as much after it.
  const SweepMotionOptions options;
  const Matrix3d more = motion.covariance - expected;
  EXPECT_GT(more.diagonal().minCoeff(), -1e-9);
  EXPECT_LT(more.norm(), std::sqrt(2.0) * std::pow(0.021 * options.acceleration_m_per_s2, 2));
}

TEST_P(Stamps, BetweenTwoReadingsTheMotionIsTheirs) {
  // The sweep does not begin and end at readings.
  const SweepMotion motion = motion_at(1.5037, driven(0.0, 3.0, 0.05), scanner(GetParam()));
  EXPECT_TRUE(motion.known);
  // Between readings the history goes straight.
  expect_near(motion.twist, kDrive, 0.05);
}

INSTANTIATE_TEST_SUITE_P(All, Stamps,
                         testing::Values(SweepMoment::start, SweepMoment::middle,
                                         SweepMoment::end));

TEST(SweepMotion, FollowsTheMotionOfTheSweepAndNotOfBefore) {
  PoseHistory history;  // stands until 1 s, then drives
  for (int i = 0; i <= 100; ++i) {
    const double t = 0.02 * i;
    history.add({t, moved(kDrive, std::max(0.0, t - 1.0))});
  }
  expect_near(motion_at(1.0, history, scanner(SweepMoment::end)).twist, {}, 1e-9);
  expect_near(motion_at(1.0, history, scanner(SweepMoment::start)).twist, kDrive, 1e-9);
  const Twist2 half = Twist2::from_vector(0.5 * kDrive.vector());
  expect_near(motion_at(1.0, history, scanner(SweepMoment::middle)).twist, half, 1e-9);
}

TEST(SweepMotion, OdometryThatEndsAtTheStampIsUsedAsFarAsItGoes) {
  const SweepMotionOptions options;
  const PoseHistory history = driven(0.0, 1.5, 0.02);
  const auto part_of_lag = [&](SweepMoment stamp) {
    const SweepMotion motion = motion_at(1.5, history, scanner(stamp));
    EXPECT_TRUE(motion.known);
    expect_near(motion.twist, kDrive, 1e-9);
    const Matrix3d of_noise = move_covariance(moved(kDrive, kSweep), kNoise) / (kSweep * kSweep);
    const Vector3d more = (motion.covariance - of_noise).diagonal();
    EXPECT_NEAR(std::sqrt(more(0)) / options.acceleration_m_per_s2,
                std::sqrt(more(2)) / options.turn_acceleration_rad_per_s2, 1e-6);
    return std::sqrt(more(0)) / options.acceleration_m_per_s2;
  };
  EXPECT_NEAR(part_of_lag(SweepMoment::start), kSweep, 1e-6);
  EXPECT_NEAR(part_of_lag(SweepMoment::middle), kSweep / 2, 1e-6);
}

TEST(SweepMotion, OdometryThatBeginsWithinTheSweepIsUsedFromThere) {
  const SweepMotion motion = motion_at(1.5, driven(1.5, 3.0, 0.02), scanner(SweepMoment::end));
  EXPECT_TRUE(motion.known);
  expect_near(motion.twist, kDrive, 1e-9);
  EXPECT_GT(motion.covariance(0, 0), kSweep * kSweep);
}

TEST(SweepMotion, AHistoryShorterThanTheSweepCountsWithItsShortness) {
  const PoseHistory history = driven(1.46, 1.5, 0.02);
  const SweepMotion motion = motion_at(1.5, history, scanner(SweepMoment::end));
  EXPECT_TRUE(motion.known);
  expect_near(motion.twist, kDrive, 1e-9);
  const Matrix3d of_noise = move_covariance(moved(kDrive, 0.04), kNoise) / (0.04 * 0.04);
  EXPECT_GT(motion.covariance(0, 0), of_noise(0, 0));
}

TEST(SweepMotion, OnePosePerScanIsLessCertain) {
  const SweepMotion motion = motion_at(2.0, driven(0.0, 2.0, 0.4), scanner(SweepMoment::middle));
  EXPECT_TRUE(motion.known);
  // The chord over 0.4 s instead of the arc: the course, not the speed.
  EXPECT_NEAR(motion.twist.velocity().norm(), kDrive.velocity().norm(), 0.03);
  EXPECT_NEAR(motion.twist.omega, kDrive.omega, 1e-9);
  EXPECT_GT(motion.covariance(0, 0), 0.2 * 0.2);
}

TEST(SweepMotion, TheCovarianceIsThatOfTheReportedMoves) {
  const Matrix3d declared = move_covariance(moved(kDrive, kSweep), kNoise);
  const Matrix3d root = declared.llt().matrixL();
  std::mt19937_64 random(4);
  std::normal_distribution<double> normal;
  Matrix3d sampled = Matrix3d::Zero();
  SweepMotion motion;
  const int count = 20000;
  for (int i = 0; i < count; ++i) {
    const Vector3d error = root * test::drawn<3>([&] { return normal(random); });
    PoseHistory history(2);
    history.add({1.4, {}});
    history.add({1.6, Pose2::from_vector(moved(kDrive, kSweep).vector() + error)});
    motion = motion_at(1.5, history, scanner(SweepMoment::middle));
    const Vector3d off = motion.twist.vector() - kDrive.vector();
    sampled += off * off.transpose() / count;
  }
  // The twist's axes are those of the middle of the move, the noise's those of its start.
  EXPECT_LT((sampled - motion.covariance).norm(), 0.1 * sampled.norm());
}

TEST(SweepMotion, WithoutOdometryItIsAGuess) {
  const SweepMotionOptions options;
  const auto expect_unknown = [&](double stamp, const PoseHistory& history,
                                  const ScannerModel& model) {
    const SweepMotion motion = motion_at(stamp, history, model);
    EXPECT_FALSE(motion.known);
    expect_near(motion.twist, {}, 0.0);
    EXPECT_DOUBLE_EQ(motion.covariance(1, 1),
                     options.speed_sigma_m_per_s * options.speed_sigma_m_per_s);
    EXPECT_DOUBLE_EQ(motion.covariance(2, 2),
                     options.turn_rate_sigma_rad_per_s * options.turn_rate_sigma_rad_per_s);
  };
  const ScannerModel moving = scanner(SweepMoment::middle);
  expect_unknown(1.5, PoseHistory(), moving);
  expect_unknown(1.5, driven(1.5, 1.5, 0.02), moving);
  expect_unknown(11.5, driven(0.0, 1.5, 0.02), moving);                            // long ago
  expect_unknown(1.5, driven(11.5, 12.5, 0.02), moving);                           // later
  expect_unknown(std::nan(""), driven(0.0, 3.0, 0.02), moving);                    // no time
  expect_unknown(1.5, driven(0.0, 3.0, 0.02), scanner(SweepMoment::middle, 0.0));  // no sweep
  PoseHistory jumped = driven(0.0, 3.0, 0.02);
  jumped.add({1.51, {500.0, 0.0, 0.0}});
  jumped.add({1.59, {500.0, 0.0, 0.0}});
  expect_unknown(1.5, jumped, scanner(SweepMoment::start, 0.09));
}

}  // namespace
}  // namespace adit
