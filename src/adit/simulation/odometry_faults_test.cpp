#include "adit/simulation/odometry_faults.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "adit/simulation/carried_off.hpp"
#include "adit/simulation/vehicle.hpp"

namespace adit {
namespace {

ScannerSpec few_beams() {
  ScannerSpec spec = cyclone();
  spec.beams = 8;
  spec.bearing_step = kTwoPi / 8;
  return spec;
}

/// No error but the faults.
DriveOptions failing(const OdometryFaults& faults) {
  DriveOptions options;
  options.odometry = {0.0, 0.0, 0.0, 0.0, 0.0};
  options.first_guess_sigma_m = 0.0;
  options.first_guess_sigma_rad = 0.0;
  options.faults = faults;
  return options;
}

/// 20 m ahead at 1 m/s, then 5 s of standing, then half a turn to the left in 5 s.
TimedPath ahead_stand_turn() {
  const Pose2 end{20.0, 0.0, 0.0};
  return {{{0.0, Pose2{}}, {20.0, end}, {25.0, end}, {30.0, {20.0, 0.0, 0.5 * kPi}}}};
}

Recording record(const OdometryFaults& faults, std::uint64_t seed = 1) {
  const ScannerSpec spec = few_beams();
  return record_drive({}, ahead_stand_turn(), {&spec, 1}, failing(faults), seed);
}

Pose2 shown(const Recording& recording, double from, double to) {
  const auto at = [&](double t) {
    const auto found = std::find_if(recording.truth.begin(), recording.truth.end(),
                                    [&](const StampedPose& pose) { return pose.stamp > t - 1e-6; });
    return recording.odometry[static_cast<std::size_t>(found - recording.truth.begin())];
  };
  return inverse(at(from)) * at(to);
}

void expect_pose(const Pose2& pose, const Pose2& expected, double tolerance = 1e-9) {
  EXPECT_NEAR(pose.x, expected.x, tolerance);
  EXPECT_NEAR(pose.y, expected.y, tolerance);
  EXPECT_NEAR(angle_between(expected.theta, pose.theta), 0.0, tolerance);
}

TEST(OdometryFaults, LastingErrorsAreThoseStated) {
  expect_pose(shown(record({.odometry_scale = 0.05}), 0, 20), {21.0, 0.0, 0.0});
  expect_pose(shown(record({.odometry_scale = 0.05}), 25, 30), {0.0, 0.0, 0.5 * kPi});
  expect_pose(shown(record({.turn_scale = -0.1}), 25, 30), {0.0, 0.0, 0.45 * kPi});
  expect_pose(shown(record({.turn_scale = -0.1}), 0, 20), {20.0, 0.0, 0.0});
  EXPECT_NEAR(shown(record({.turn_bias = 0.01}), 0, 20).theta, 0.2, 1e-9);
  EXPECT_NEAR(shown(record({.turn_bias = 0.01}), 25, 30).theta, 0.5 * kPi, 1e-9);
}

TEST(OdometryFaults, SlipComesOnTopOfTheScale) {
  DriveOptions options = failing({.odometry_scale = 0.05});
  options.slip_ratio = 0.1;
  const ScannerSpec spec = few_beams();
  const Recording recording = record_drive({}, ahead_stand_turn(), {&spec, 1}, options, 1);
  expect_pose(shown(recording, 0, 20), {20.0 * 1.05 * 1.1, 0.0, 0.0});
}

TEST(OdometryFaults, SlipInBurstsHasTheStatedRatioAndShare) {
  const TimedPath path{{{0.0, Pose2{}}, {4000.0, {4000.0, 0.0, 0.0}}}};
  const ScannerSpec spec = few_beams();
  const DriveOptions options = failing({.burst_ratio = 0.3, .burst_m = 4.0, .calm_m = 8.0});
  const Recording recording = record_drive({}, path, {&spec, 1}, options, 7);
  int bursts = 0;
  double longest = 0.0;
  double length = 0.0;
  for (std::size_t i = 1; i < recording.odometry.size(); ++i) {
    const double moved = recording.odometry[i].x - recording.odometry[i - 1].x;
    const bool slips = moved > 0.25;
    EXPECT_NEAR(moved, slips ? 0.26 : 0.2, 1e-9);
    length = slips ? length + 0.2 : 0.0;
    longest = std::max(longest, length);
    bursts += length > 0.1 && length < 0.3 ? 1 : 0;
  }
  EXPECT_NEAR(bursts, 4000.0 / 12.2, 25.0);
  EXPECT_GT(longest, 5.0);
  EXPECT_LE(longest, 6.2 + 1e-9);
  EXPECT_NEAR(recording.odometry.back().x, 4000.0 * (1.0 + 0.3 / 3.0), 20.0);
}

TEST(OdometryFaults, WheelsCreepWhileTheMachineStands) {
  const Recording recording = record({.creep = 0.04});
  expect_pose(shown(recording, 0, 20), {20.0, 0.0, 0.0});
  expect_pose(shown(recording, 20, 25), {0.2, 0.0, 0.0});
  expect_pose(shown(recording, 25, 30), {0.0, 0.0, 0.5 * kPi});
}

TEST(OdometryFaults, WheelsStandWhileTheMachineCreeps) {
  const TimedPath path{{{0.0, Pose2{}}, {10.0, {0.5, 0, 0}}, {15.0, {5.5, 0, 0}}}};
  const ScannerSpec spec = few_beams();
  const Recording recording =
      record_drive({}, path, {&spec, 1}, failing({.unreported_below = 0.1}), 1);
  expect_pose(shown(recording, 0, 10), Pose2{});
  expect_pose(shown(recording, 10, 15), {5.0, 0.0, 0.0});
}

TEST(OdometryFaults, DropoutsLeaveScansAndWheelsWithoutOdometry) {
  const Recording whole = record({});
  const Recording recording = record({.dropouts = 1, .dropout_s = 3.0}, 4);
  ASSERT_EQ(recording.is_without_odometry.size(), recording.scans.size());
  EXPECT_NEAR(static_cast<double>(std::count(recording.is_without_odometry.begin(),
                                             recording.is_without_odometry.end(), true)),
              15.0, 1.0);
  EXPECT_NEAR(static_cast<double>(whole.wheels.size() - recording.wheels.size()), 150.0, 1.0);
  double lost_from = -1.0;
  for (std::size_t i = 1; i < recording.scans.size(); ++i) {
    if (recording.is_without_odometry[i]) {
      if (lost_from < 0.0) lost_from = recording.scans[i].stamp;
      EXPECT_FALSE(recording.odometry_at(i));
      EXPECT_EQ(recording.odometry[i].vector(), recording.odometry[i - 1].vector());
      EXPECT_LT(recording.scans[i].stamp, lost_from + 3.0);
    } else {  // what was driven in the gap shows after it
      EXPECT_EQ(recording.odometry_at(i)->vector(), whole.odometry[i].vector());
    }
  }
}

TEST(OdometryFaults, FreezesForGood) {
  const Recording recording = record({.freeze_s = 10.0});
  expect_pose(shown(recording, 0, 10), {10.0, 0.0, 0.0});
  for (std::size_t i = 0; i < recording.scans.size(); ++i) {
    EXPECT_FALSE(recording.is_without_odometry[i]);
    if (recording.scans[i].stamp < 10.0) continue;
    EXPECT_EQ(recording.odometry[i].vector(), recording.odometry.back().vector());
  }
  EXPECT_EQ(recording.wheels.back().pose.vector(), recording.odometry.back().vector());
}

TEST(OdometryFaults, JumpsMoveAllPosesThereafterRigidly) {
  const Recording whole = record({});
  const Recording recording = record({.jumps = 1, .jump_m = 2.0, .jump_rad = 0.3}, 3);
  std::size_t jumped = 0;
  for (std::size_t i = 1; i < recording.scans.size(); ++i) {
    const Pose2 move = inverse(recording.odometry[i - 1]) * recording.odometry[i];
    const Pose2 driven = inverse(whole.odometry[i - 1]) * whole.odometry[i];
    if ((move.translation() - driven.translation()).norm() < 1e-9) {
      expect_pose(move, driven);
      continue;
    }
    ++jumped;
    EXPECT_NEAR((move.translation() - driven.translation()).norm(), 2.0, 0.1);
    EXPECT_NEAR(std::abs(angle_between(driven.theta, move.theta)), 0.3, 1e-9);
  }
  EXPECT_EQ(jumped, 1u);
}

TEST(OdometryFaults, AbsentOdometryIsNowhere) {
  const Recording recording = record({.is_absent = true});
  EXPECT_TRUE(recording.wheels.empty());
  for (std::size_t i = 0; i < recording.scans.size(); ++i) {
    EXPECT_FALSE(recording.odometry_at(i));
    EXPECT_EQ(recording.odometry[i].vector(), recording.first_guess.pose.vector());
  }
}

TEST(OdometryFaults, BefallStopsAsWell) {
  const std::vector<Pose2> stops = {{0, 0, 0}, {2, 0, 0}, {4, 0, 0}, {6, 0, 0}};
  const auto odometry = [&](const OdometryFaults& faults) {
    return record_stops({}, stops, few_beams(), failing(faults), 1).odometry;
  };
  EXPECT_NEAR(odometry({.odometry_scale = 0.05}).back().x, 6.3, 1e-12);
  EXPECT_NEAR(odometry({.freeze_s = 3.5}).back().x, 2.0, 1e-12);
}

TEST(CarriedOff, ShowsNoMoveWhileTheTruthMoves) {
  Recording first = record({});
  const std::vector<Pose2> path = {{100, 50, 1}, {110, 50, 1}};
  const DriveOptions options = failing({.dropouts = 1});
  ScannerSpec sweeping = few_beams();
  sweeping.model.sweep_s = 0.1;
  sweeping.model.stamp = SweepMoment::end;  // the first scan is not at time 0
  const Recording second = record_drive({}, path, sweeping, options, 5);
  const std::size_t n = first.scans.size();
  const Recording both = carried_off(first, second);
  ASSERT_EQ(both.scans.size(), n + second.scans.size());
  ASSERT_EQ(both.truth.size(), both.scans.size());
  ASSERT_EQ(both.gyro.size(), both.scans.size());
  ASSERT_EQ(both.is_without_odometry.size(), both.scans.size());
  expect_pose(inverse(both.odometry[n - 1]) * both.odometry[n], Pose2{});
  EXPECT_EQ(both.truth[n].pose.vector(), second.truth[0].pose.vector());
  EXPECT_NEAR(both.scans[n].stamp - both.scans[n - 1].stamp, 0.2, 1e-9);
  EXPECT_NEAR(angle_between(both.gyro[n - 1], both.gyro[n]), 0.0, 1e-9);
  for (std::size_t i = 1; i < second.scans.size(); ++i) {
    EXPECT_EQ(both.is_without_odometry[n + i], second.is_without_odometry[i]);
    expect_pose(inverse(both.odometry[n]) * both.odometry[n + i],
                inverse(second.odometry[0]) * second.odometry[i]);
    EXPECT_EQ(both.scans[n + i].ranges, second.scans[i].ranges);
  }
  for (std::size_t i = 1; i < both.wheels.size(); ++i) {
    EXPECT_GT(both.wheels[i].stamp, both.wheels[i - 1].stamp);
  }
  EXPECT_NEAR(both.wheels.back().stamp - both.scans.back().stamp,
              second.wheels.back().stamp - second.scans.back().stamp, 1e-9);
  expect_pose(both.wheels.back().pose,
              both.odometry[n] * inverse(second.odometry[0]) * second.wheels.back().pose);
  const Pose2 shown{0.2, 0.0, 0.1};
  const Recording driven_on = carried_off(first, second, shown);
  expect_pose(inverse(driven_on.odometry[n - 1]) * driven_on.odometry[n], shown);
}

}  // namespace
}  // namespace adit
