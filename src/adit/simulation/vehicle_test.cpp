#include "adit/simulation/vehicle.hpp"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <cmath>

#include "adit/simulation/clutter.hpp"
#include "adit/simulation/dead_reckoning.hpp"
#include "adit/simulation/mine_worlds.hpp"

namespace adit {
namespace {

/// FNV-1a over numbers rounded to 1e-6: the same wherever the arithmetic is right.
std::uint64_t digest(const Recording& recording) {
  std::uint64_t hash = 0xCBF29CE484222325u;
  const auto add = [&](double value) {
    auto bits = static_cast<std::uint64_t>(std::llround(value * 1e6));
    for (int i = 0; i < 8; ++i, bits >>= 8) hash = (hash ^ (bits & 0xFFu)) * 0x100000001B3u;
  };
  for (const LaserScan& scan : recording.scans) {
    for (const double range : scan.ranges) add(range);
  }
  for (const Pose2& pose : recording.odometry) {
    for (const double value : pose.vector()) add(value);
  }
  for (const double heading : recording.gyro) add(heading);
  return hash;
}

ScannerSpec few_beams() {
  ScannerSpec spec = cyclone();
  spec.beams = 8;
  spec.bearing_step = kTwoPi / 8;
  return spec;
}

void expect_same_pose(const Pose2& a, const Pose2& b, double tolerance) {
  EXPECT_NEAR(a.x, b.x, tolerance);
  EXPECT_NEAR(a.y, b.y, tolerance);
  EXPECT_NEAR(angle_between(a.theta, b.theta), 0.0, tolerance);
}

DriveOptions perfect() {
  DriveOptions options;
  options.odometry = {0.0, 0.0, 0.0, 0.0, 0.0};
  return options;
}

TEST(MoveError, HasExactlyTheDeclaredCovariance) {
  Random random(9);
  const OdometryNoise noise;
  const Pose2 move{1.5, 0.3, 0.4};
  Matrix3d sum = Matrix3d::Zero();
  const int count = 100000;
  for (int i = 0; i < count; ++i) {
    const Vector3d error = draw_move_error(move, noise, random);
    sum += error * error.transpose() / count;
  }
  const Matrix3d declared = move_covariance(move, noise);
  EXPECT_LT((sum - declared).cwiseAbs().maxCoeff(), 0.02 * declared.cwiseAbs().maxCoeff());
}

TEST(MoveError, IsNothingForAMachineAtRestWithoutFloors) {
  Random random(9);
  EXPECT_EQ(draw_move_error({}, mockup_odometry(), random), Vector3d(Vector3d::Zero()));
}

TEST(RecordStops, StandsOnThePathAndStartsAtTheFirstGuess) {
  const World world = mockup();
  const Recording run = record_stops(world, world.path, cyclone(), {}, 3);
  ASSERT_EQ(run.scans.size(), 16u);
  ASSERT_EQ(run.odometry.size(), 16u);
  ASSERT_EQ(run.truth.size(), 16u);
  ASSERT_EQ(run.gyro.size(), 16u);
  for (std::size_t i = 0; i < 16; ++i) {
    expect_same_pose(run.truth[i].pose, world.path[i], 1e-12);
    EXPECT_EQ(run.truth[i].stamp, run.scans[i].stamp);
  }
  expect_same_pose(run.odometry[0], run.first_guess.pose, 0.0);
}

TEST(RecordStops, OdometryErrsByFivePercentAndTwoDegreesAStep) {
  const World world = mockup();
  double nees = 0.0;
  double turn_squares = 0.0;
  int count = 0;
  for (std::uint64_t seed = 0; seed < 400; ++seed) {
    const Recording run = record_stops(world, world.path, few_beams(), {}, seed);
    for (std::size_t i = 1; i < 16; ++i, ++count) {
      const Pose2 move = inverse(run.truth[i - 1].pose) * run.truth[i].pose;
      const Pose2 reported = inverse(run.odometry[i - 1]) * run.odometry[i];
      const Vector3d error(reported.x - move.x, reported.y - move.y,
                           angle_between(move.theta, reported.theta));
      nees += error.dot(move_covariance(move, mockup_odometry()).ldlt().solve(error));
      const double step = move.translation().norm() / 1.6;
      turn_squares += error.z() * error.z() / (step * step);
    }
  }
  EXPECT_NEAR(nees / count, 3.0, 0.1);
  EXPECT_NEAR(degrees(std::sqrt(turn_squares / count)), 2.0, 0.05);
}

TEST(RecordStops, FirstGuessErrsAsDeclared) {
  const World world = mockup();
  const std::vector<Pose2> start{world.path.front()};
  Vector3d squares = Vector3d::Zero();
  for (std::uint64_t seed = 0; seed < 3000; ++seed) {
    const Recording run = record_stops(world, start, few_beams(), {}, seed);
    const Pose2& guess = run.first_guess.pose;
    const Vector3d error(guess.x - start[0].x, guess.y - start[0].y,
                         angle_between(start[0].theta, guess.theta));
    squares += error.cwiseAbs2() / 3000.0;
  }
  EXPECT_NEAR(std::sqrt(squares.x()), 0.15, 0.01);
  EXPECT_NEAR(std::sqrt(squares.y()), 0.15, 0.01);
  EXPECT_NEAR(degrees(std::sqrt(squares.z())), 2.0, 0.1);
}

TEST(RecordStops, HopsAreHiddenFromTheOdometry) {
  const World world = mockup();
  DriveOptions options = perfect();
  options.hops = 3;
  const Recording run = record_stops(world, world.path, few_beams(), options, 5);
  int hopped = 0;
  for (std::size_t i = 1; i < 16; ++i) {
    const Pose2 seen = inverse(run.odometry[i - 1]) * run.odometry[i];
    const Pose2 planned = inverse(run.truth[i - 1].pose) * world.path[i];
    expect_same_pose(seen, planned, 1e-9);
    if ((run.truth[i].pose.translation() - world.path[i].translation()).norm() > 0.01) ++hopped;
  }
  EXPECT_GE(hopped, 1);
  EXPECT_LE(hopped, 3);
}

TEST(RecordStops, GyroReportsHeadingsInSteps) {
  const World world = mockup();
  const Recording run = record_stops(world, world.path, few_beams(), {}, 5);
  for (std::size_t i = 0; i < 16; ++i) {
    EXPECT_LE(std::abs(angle_between(run.gyro[i], run.truth[i].pose.theta)), radians(0.1251));
    const double steps = degrees(run.gyro[i]) / 0.25;
    EXPECT_NEAR(steps, std::round(steps), 1e-6);
  }
}

TEST(RecordDrive, WithoutErrorsTheOdometryIsTheTruth) {
  const World world = mockup();
  DriveOptions options = perfect();
  const Recording run = record_drive(world, world.path, few_beams(), options, 2);
  ASSERT_GT(run.scans.size(), 100u);
  ASSERT_GT(run.wheels.size(), 1000u);
  const Pose2 odom_from_map = run.first_guess.pose * inverse(run.truth.front().pose);
  for (std::size_t i = 0; i < run.truth.size(); ++i) {
    expect_same_pose(run.odometry[i], odom_from_map * run.truth[i].pose, 1e-9);
  }
  const TimedPath path =
      drive_along(world.path, options.speed_m_per_s, options.turn_rate_rad_per_s);
  for (const StampedPose& wheel : run.wheels) {
    expect_same_pose(wheel.pose, odom_from_map * path.at(wheel.stamp), 1e-9);
  }
}

TEST(RecordDrive, WheelsPassThroughTheOdometryAtTheScans) {
  const World world = drift({}, 1);
  DriveOptions options;
  options.slip_ratio = 0.02;
  const Recording run = record_drive(world, world.path, few_beams(), options, 2);
  std::size_t wheel = 0;
  for (std::size_t i = 0; i < run.truth.size(); ++i) {
    while (wheel < run.wheels.size() && run.wheels[wheel].stamp < run.truth[i].stamp - 1e-9) {
      ++wheel;
    }
    if (wheel == run.wheels.size()) break;
    if (std::abs(run.wheels[wheel].stamp - run.truth[i].stamp) < 1e-9) {
      expect_same_pose(run.wheels[wheel].pose, run.odometry[i], 1e-9);
    }
  }
}

TEST(RecordDrive, SlipMakesTheWheelsReportMore) {
  const World world = drift({}, 1);
  DriveOptions options = perfect();
  options.slip_ratio = 0.1;
  const Recording run = record_drive(world, world.path, few_beams(), options, 2);
  double driven = 0.0;
  double reported = 0.0;
  for (std::size_t i = 1; i < run.truth.size(); ++i) {
    driven += (run.truth[i].pose.translation() - run.truth[i - 1].pose.translation()).norm();
    reported += (run.odometry[i].translation() - run.odometry[i - 1].translation()).norm();
  }
  EXPECT_NEAR(reported / driven, 1.1, 1e-6);
}

TEST(RecordDrive, ErrsAsDeclaredBetweenScans) {
  const World world = mockup();
  double nees = 0.0;
  int count = 0;
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    const Recording run = record_drive(world, world.path, few_beams(), {}, seed);
    for (std::size_t i = 1; i < run.truth.size(); ++i) {
      const Pose2 move = inverse(run.truth[i - 1].pose) * run.truth[i].pose;
      const Pose2 reported = inverse(run.odometry[i - 1]) * run.odometry[i];
      if (move.translation().norm() < 1e-3) continue;
      const Vector3d error(reported.x - move.x, reported.y - move.y,
                           angle_between(move.theta, reported.theta));
      nees += error.dot(move_covariance(move, mockup_odometry()).ldlt().solve(error));
      ++count;
    }
  }
  EXPECT_NEAR(nees / count, 3.0, 0.15);
}

TEST(RecordDrive, ItsErrorCanChangeBetweenTheScans) {
  const World world = mockup();
  DriveOptions options;
  options.odometry_error_lead = 0.5;
  double nees = 0.0;
  double steadiness = 0.0;
  int count = 0;
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    const Recording run = record_drive(world, world.path, few_beams(), options, seed);
    const TimedPath truth =
        drive_along(world.path, options.speed_m_per_s, options.turn_rate_rad_per_s);
    // Scans lie 0.2 s apart, so errors change 0.1 s after each; wheels are read every 0.02 s.
    for (std::size_t k = 5; k + 10 < run.wheels.size(); k += 10) {
      const auto error_until = [&](std::size_t end) {
        const Pose2 move = inverse(truth.at(run.wheels[k].stamp)) * truth.at(run.wheels[end].stamp);
        const Pose2 reported = inverse(run.wheels[k].pose) * run.wheels[end].pose;
        return Vector3d(reported.x - move.x, reported.y - move.y,
                        angle_between(move.theta, reported.theta));
      };
      const Pose2 move =
          inverse(truth.at(run.wheels[k].stamp)) * truth.at(run.wheels[k + 10].stamp);
      if (move.translation().norm() < 0.19) continue;
      const Vector3d error = error_until(k + 10);
      nees += error.dot(move_covariance(move, options.odometry).ldlt().solve(error));
      steadiness = std::max(steadiness, (error_until(k + 5) - 0.5 * error).norm());
      ++count;
    }
  }
  ASSERT_GT(count, 1000);
  EXPECT_NEAR(nees / count, 3.0, 0.15);
  EXPECT_LT(steadiness, 1e-3);
}

TEST(RecordDrive, SweepsLieWithinTheDrive) {
  const World world = mockup();
  ScannerSpec spec = few_beams();
  spec.model.sweep_s = 0.1;
  spec.model.stamp = SweepMoment::end;
  const Recording run = record_drive(world, world.path, spec, {}, 2);
  EXPECT_DOUBLE_EQ(run.truth.front().stamp, 0.1);
  const Recording still = record_drive(world, {world.path.data(), 1}, spec, {}, 2);
  EXPECT_EQ(still.scans.size(), 1u);
  EXPECT_TRUE(record_drive(world, {}, spec, {}, 2).scans.empty());
}

TEST(Hop, JumpsOnceAndSteersBack) {
  const TimedPath path{{{0.0, {0.0, 0.0, 0.0}}, {10.0, {10.0, 0.0, 0.0}}}};
  const TimedPath hopped = with_hop(path, 4.0, {0.0, 0.3, 0.1}, 2.0);
  EXPECT_NEAR(hopped.at(3.999999).y, 0.0, 1e-9);
  EXPECT_NEAR(hopped.at(4.0).y, 0.3, 1e-9);
  EXPECT_NEAR(hopped.at(5.0).y, 0.15, 1e-3);
  expect_same_pose(hopped.at(7.0), path.at(7.0), 1e-9);
  const TimedPath felt = without_jumps(hopped);
  // The wheels see no jump: they report the way back only.
  EXPECT_NEAR(felt.at(4.0).y, 0.0, 1e-9);
  const Pose2 back = inverse(hopped.at(4.0)) * hopped.at(7.0);
  expect_same_pose(inverse(felt.at(4.0)) * felt.at(7.0), back, 1e-9);
}

TEST(Recordings, AreTheSameEverywhere) {
  World world = mockup();
  add_clutter(world, clutter_of(8), 42);
  const Recording run = record_stops(world, world.path, cyclone(), {}, 42);
  EXPECT_EQ(digest(run), digest(record_stops(world, world.path, cyclone(), {}, 42)));
  EXPECT_NE(digest(run), digest(record_stops(world, world.path, cyclone(), {}, 43)));
  // Golden: changes only with a deliberate change of the simulation.
  EXPECT_EQ(digest(run), 17194294148199106233u);
}

TEST(Recordings, ClutterLeavesTheWheelsAlone) {
  World world = mockup();
  const Recording bare = record_stops(world, world.path, few_beams(), {}, 42);
  add_clutter(world, clutter_of(8), 42);
  const Recording full = record_stops(world, world.path, few_beams(), {}, 42);
  for (std::size_t i = 0; i < 16; ++i) {
    expect_same_pose(bare.odometry[i], full.odometry[i], 0.0);
  }
}

}  // namespace
}  // namespace adit
