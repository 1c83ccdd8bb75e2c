// What the localizer makes of wheels, gyro and stamps.
#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "support/room_drive.hpp"

namespace adit {
namespace {

using namespace testing;  // NOLINT(google-build-using-namespace): the scene

class DeadReckoningTest : public RoomDrive {};

TEST_F(DeadReckoningTest, TheGyroReplacesTheRotationOfTheWheels) {
  const Pose2 wrong_move{0.5, 0.0, 0.5};  // the wheels slip; the vehicle did not turn so far
  const double gyro_turn = -0.2;
  Localizer localizer(map, settings());
  localizer.start(rough_guess(drive.truth[0]));
  localizer.add_gyro(100.0, 3.1);  // its zero is arbitrary, and the step below passes pi
  const Estimate before = localizer.update(drive.scans[0], drive.odometry[0]);
  localizer.add_gyro(101.0, wrap_angle(3.1 + gyro_turn));
  const Estimate after = localizer.update(blind_scan(101.0), drive.odometry[0] * wrong_move);
  expect_near(after.pose, before.pose * Pose2{0.5, 0.0, gyro_turn}, 1e-12);
  const double sigma = settings().localizer.gyro_sigma_rad;
  EXPECT_NEAR(after.covariance(2, 2), before.covariance(2, 2) + sigma * sigma, 1e-12);

  Localizer without(map, settings());
  without.start(rough_guess(drive.truth[0]));
  without.update(drive.scans[0], drive.odometry[0]);
  const Estimate& blind = without.update(blind_scan(101.0), drive.odometry[0] * wrong_move);
  expect_near(blind.pose, before.pose * wrong_move, 1e-12);
}

TEST_F(DeadReckoningTest, TheGyroIsReadAtTheStampOfTheScan) {
  Localizer localizer(map, settings());
  localizer.start(drive.truth[0]);
  for (int i = 0; i <= 20; ++i) localizer.add_gyro(100.0 + 0.1 * i, 3.0 + 0.05 * i);
  const Estimate before = localizer.update(drive.scans[0], Pose2{});
  const Estimate& after = localizer.update(blind_scan(101.25), Pose2{});
  EXPECT_NEAR(angle_between(before.pose.theta, after.pose.theta), 0.625, 1e-9);
}

TEST_F(DeadReckoningTest, AGyroThatFallsSilentLeavesTheTurnToTheWheels) {
  Localizer localizer(map, settings());
  localizer.start(rough_guess(drive.truth[0]));
  localizer.add_gyro(drive.scans[0].stamp, 0.0);
  localizer.add_gyro(drive.scans[1].stamp, 0.0);
  double heading = 0.0;
  for (std::size_t i = 0; i < drive.scans.size(); ++i) {
    LaserScan late = drive.scans[i];
    late.stamp += 100.0;  // long after the gyro's last word
    localizer.update(late, drive.odometry[i]);
    const Pose2 move = i > 0 ? inverse(drive.odometry[i - 1]) * drive.odometry[i] : Pose2{};
    if (i > 0) {
      EXPECT_NEAR(angle_between(heading, localizer.last_turn().predicted.pose.theta), move.theta,
                  1e-9)
          << i;
    }
    heading = localizer.estimate().pose.theta;
  }
}

TEST_F(DeadReckoningTest, OnlyDifferencesOfTheOdometryCount) {
  const auto expected = run(drive);
  Drive moved = drive;
  for (Pose2& pose : moved.odometry) pose = Pose2{-40.0, 17.0, 2.5} * pose;
  const auto estimates = run(moved);
  for (std::size_t i = 0; i < expected.size(); ++i) {
    expect_near(estimates[i].pose, expected[i].pose, 1e-9);
    EXPECT_TRUE(estimates[i].covariance.isApprox(expected[i].covariance, 1e-6));
  }
}

TEST_F(DeadReckoningTest, OdometryMayComeInAnyOrderAndTwice) {
  std::vector<StampedPose> stream;
  for (std::size_t i = 0; i < drive.odometry.size(); ++i) {
    stream.push_back({drive.scans[i].stamp, drive.odometry[i]});
    stream.push_back({drive.scans[i].stamp, drive.odometry[i]});
  }
  std::mt19937 random(5);
  for (std::size_t i = stream.size(); i > 1; --i) std::swap(stream[i - 1], stream[random() % i]);
  Localizer localizer(map, settings());
  localizer.start(rough_guess(drive.truth.front()));
  for (const StampedPose& pose : stream) localizer.add_odometry(pose);
  const auto expected = run(drive);
  for (std::size_t i = 0; i < drive.scans.size(); ++i) {
    EXPECT_EQ(localizer.update(drive.scans[i]).pose.vector(), expected[i].pose.vector()) << i;
  }
}

TEST_F(DeadReckoningTest, ScansWithEarlierOrRepeatedStampsAreAnsweredInTheOrderOfTheLog) {
  Drive shuffled = drive;
  shuffled.scans[5].stamp = shuffled.scans[3].stamp - 0.5;
  shuffled.scans[6].stamp = shuffled.scans[5].stamp;
  const auto expected = run(drive);
  const auto estimates = run(shuffled);
  for (std::size_t i = 0; i < estimates.size(); ++i) {
    EXPECT_EQ(estimates[i].stamp, shuffled.scans[i].stamp);
    EXPECT_EQ(estimates[i].pose.vector(), expected[i].pose.vector()) << i;
  }
}

TEST_F(DeadReckoningTest, WithoutOdometryAStandingVehicleIsFollowed) {
  Localizer localizer(map, settings());
  localizer.start(rough_guess(drive.truth[0]));
  for (int i = 0; i < 3; ++i) {
    const Estimate& e = localizer.update(drive.scans[0]);
    EXPECT_EQ(e.status, Status::ok);
    EXPECT_LT(position_error(e.pose, drive.truth[0]), 0.01);
  }
}

}  // namespace
}  // namespace adit
