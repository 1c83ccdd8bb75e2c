#include "adit/scan_motion/scan_motion.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "adit/geometry/segment.hpp"
#include "adit/simulation/random.hpp"
#include "support/repeats.hpp"

namespace adit {
namespace {

constexpr double kNoise = 0.015;  // m, one sigma

/// Metres along a beam to the nearest of the walls, by looking at all.
double cast(const std::vector<Segment>& walls, const Vector2d& eye, const Vector2d& beam) {
  double nearest = std::numeric_limits<double>::infinity();
  for (const Segment& wall : walls) {
    const Vector2d along = wall.b - wall.a;
    const double turn = cross(beam, along);
    if (turn == 0.0) continue;
    const double range = cross(wall.a - eye, along) / turn;
    const double share = cross(wall.a - eye, beam) / turn;
    if (range > 0.0 && share >= 0.0 && share <= 1.0) nearest = std::min(nearest, range);
  }
  return nearest;
}

ScannerModel scanner() {
  ScannerModel model;
  model.range_sigma_m = kNoise;
  model.quantisation_m = 0.0;
  model.max_range_m = 20.0;
  return model;
}

/// What a scanner of 361 beams over 270 degrees reports, 0.4 m ahead of the vehicle's middle.
LaserScan scan_from(const Pose2& vehicle, const std::vector<Segment>& walls, Random& random) {
  LaserScan scan;
  scan.first_bearing = -0.75 * kPi;
  scan.bearing_step = kPi / 240.0;
  scan.max_range = scanner().max_range_m;
  scan.vehicle_from_laser = {0.4, 0.0, 0.0};
  const Pose2 laser = vehicle * scan.vehicle_from_laser;
  for (std::size_t i = 0; i < 361; ++i) {
    const double range =
        cast(walls, laser.translation(), unit_vector(laser.theta + scan.bearing(i)));
    scan.ranges.push_back(std::min(scan.max_range, range + kNoise * random.normal()));
  }
  return scan;
}

/// A room of 9 m x 6 m with a recess.
std::vector<Segment> room() {
  return {{{0, 0}, {9, 0}},     {{9, 0}, {9, 6}},   {{9, 6}, {6, 6}}, {{6, 6}, {6, 7.5}},
          {{6, 7.5}, {4, 7.5}}, {{4, 7.5}, {4, 6}}, {{4, 6}, {0, 6}}, {{0, 6}, {0, 0}}};
}

/// Two walls 3 m apart whose ends are out of range, turned about the origin.
std::vector<Segment> corridor(double turn) {
  const RigidTransform carry_by(Pose2{0.0, 0.0, turn});
  const auto wall = [&](double y) {
    return Segment{carry_by.point({-200.0, y}), carry_by.point({200.0, y})};
  };
  return {wall(-1.5), wall(1.5)};
}

Matrix3d covariance_of(double sigma_m, double sigma_rad) {
  return Vector3d(sigma_m, sigma_m, sigma_rad).cwiseAbs2().asDiagonal();
}

Vector3d error_of(const Pose2& truth, const Pose2& found) { return difference(truth, found); }

/// So many poses in the room, near each other, at random.
Pose2 somewhere(Random& random) {
  return {random.uniform(3.0, 6.0), random.uniform(2.0, 4.0), random.uniform(-kPi, kPi)};
}
Pose2 small_move(Random& random) {
  return {random.uniform(0.0, 0.3), random.uniform(-0.05, 0.05), random.uniform(-0.15, 0.15)};
}

TEST(ScanMotion, FindsTheMoveInARoomAsWellAsItStates) {
  Random random(1);
  double squares = 0.0;
  constexpr int kTrials = test::repeats(200);
  for (int trial = 0; trial < kTrials; ++trial) {
    const Pose2 start = somewhere(random);
    const Pose2 truth = small_move(random);
    ScanMotion motion;
    ASSERT_TRUE(motion.lay(scan_from(start, room(), random), scanner(), {}).is_kept);
    PoseWithCovariance predicted{truth, covariance_of(0.04, 0.02)};
    predicted.pose.x += 0.04 * random.normal();
    predicted.pose.y += 0.04 * random.normal();
    predicted.pose.theta += 0.02 * random.normal();
    const ScanMove move =
        motion.lay(scan_from(start * truth, room(), random), scanner(), motion.predict(predicted));
    ASSERT_TRUE(move.is_found) << trial;
    EXPECT_GT(move.matched_share, 0.9);
    EXPECT_GT(move.closeness, 0.6);
    const Vector3d error = error_of(truth, move.last_from_vehicle);
    EXPECT_LT(error.head<2>().norm(), 0.03) << trial;
    EXPECT_LT(std::abs(error.z()), 0.01) << trial;
    const double square = error.dot(move.move_information * error);
    EXPECT_LT(square, 16.3) << trial;  // three degrees of freedom, 99.9 %
    squares += square;
  }
  // It allows for walls that err; these do not.
  EXPECT_LT(squares / kTrials, 3.0);
  EXPECT_GT(squares / kTrials, 0.1);
}

TEST(ScanMotion, LeavesOpenWhatABareCorridorDoesNotTell) {
  Random random(2);
  for (const double turn : {0.0, 0.7, -2.0}) {
    const std::vector<Segment> walls = corridor(turn);
    const Pose2 along{0.0, 0.0, turn};
    const Pose2 start = along * Pose2{0.0, 0.2, 0.4};
    const Pose2 truth{0.25, 0.1, 0.05};
    ScanMotion motion;
    motion.lay(scan_from(start, walls, random), scanner(), {start});
    // The prediction is 0.1 m off along the corridor, 0.05 m across, and turned.
    const Pose2 shifted = start * truth;
    const Vector2d off = along * Vector2d(0.1, 0.05) + shifted.translation();
    const Pose2 predicted{off.x(), off.y(), shifted.theta + 0.02};
    const ScanMove move = motion.lay(scan_from(shifted, walls, random), scanner(),
                                     {predicted, covariance_of(0.1, 0.02)});
    ASSERT_TRUE(move.is_found);
    const Vector2d axis = unit_vector(turn);
    const Vector2d error = move.frame_from_vehicle.translation() - shifted.translation();
    EXPECT_NEAR(error.dot(axis), 0.1, 0.01);
    EXPECT_NEAR(error.dot(perpendicular(axis)), 0.0, 0.01);
    EXPECT_NEAR(move.frame_from_vehicle.theta, shifted.theta, 0.005);
    const Matrix2d told = move.information.topLeftCorner<2, 2>();
    EXPECT_LT(axis.dot(told * axis), 1e-3 * told.trace());
    EXPECT_GT(told.trace(), 1e4);
    EXPECT_GT(move.information(2, 2), 1e4);
    // The same in the axes of the start, which looks 0.4 rad aside.
    const Vector2d axis_in_start = unit_vector(-0.4);
    const Matrix2d told_of_move = move.move_information.topLeftCorner<2, 2>();
    EXPECT_LT(axis_in_start.dot(told_of_move * axis_in_start), 1e-3 * told.trace());
    EXPECT_NEAR(told_of_move.trace(), told.trace(), 1e-6 * told.trace());
  }
}

TEST(ScanMotion, AScanOfElsewhereIsNotFound) {
  Random random(3);
  // A round shaft of 1.1 m, as seen from within: no wall of it is one of the room's.
  std::vector<Segment> shaft;
  for (int i = 0; i < 24; ++i) {
    shaft.push_back({1.1 * unit_vector(i * kPi / 12.0), 1.1 * unit_vector((i + 1) * kPi / 12.0)});
  }
  const Pose2 start{4.5, 3.0, 0.3};
  ScanMotion motion;
  motion.lay(scan_from(start, room(), random), scanner(), {});
  const PoseWithCovariance step{{0.1, 0.0, 0.0}, covariance_of(0.02, 0.01)};
  const ScanMove lost =
      motion.lay(scan_from({-0.4, 0.0, 0.0}, shaft, random), scanner(), motion.predict(step));
  EXPECT_FALSE(lost.is_found);
  EXPECT_LT(lost.matched_share, 0.35);
  EXPECT_EQ(lost.information.norm(), 0.0);
  EXPECT_EQ(lost.move_information.norm(), 0.0);
  EXPECT_EQ(difference(step.pose, lost.last_from_vehicle).norm(), 0.0);
  EXPECT_EQ(motion.last().vector().norm(), 0.0);
  // The next scan, of the room again, is found by the move since the last that was.
  const Pose2 truth{0.2, 0.03, 0.05};
  const PoseWithCovariance both{{0.2, 0.0, 0.05}, covariance_of(0.03, 0.02)};
  const ScanMove back =
      motion.lay(scan_from(start * truth, room(), random), scanner(), motion.predict(both));
  ASSERT_TRUE(back.is_found);
  EXPECT_LT(error_of(truth, back.last_from_vehicle).norm(), 0.02);
}

/// Rooms of other sizes: two walls that lie as far off by chance do not make it the same room.
TEST(ScanMotion, AnotherRoomIsSeldomTakenForTheSame) {
  Random random(8);
  int found = 0;
  for (int trial = 0; trial < test::repeats(100); ++trial) {
    const double w = random.uniform(3.0, 14.0);
    const double h = random.uniform(3.0, 9.0);
    const std::vector<Segment> other = {
        {{0, 0}, {w, 0}}, {{w, 0}, {w, h}}, {{w, h}, {0, h}}, {{0, h}, {0, 0}}};
    const Pose2 there{random.uniform(0.8, w - 0.8), random.uniform(0.8, h - 0.8),
                      random.uniform(-kPi, kPi)};
    ScanMotion motion;
    motion.lay(scan_from(somewhere(random), room(), random), scanner(), {});
    const PoseWithCovariance step{{0.1, 0.0, 0.0}, covariance_of(0.02, 0.01)};
    found += motion.lay(scan_from(there, other, random), scanner(), motion.predict(step)).is_found;
  }
  EXPECT_LE(found, 2);  // 1 of 500
}

TEST(ScanMotion, FindsWhatDeadReckoningDoesNotReport) {
  Random random(4);
  const Pose2 start{4.5, 3.0, 0.3};
  ScanMotion motion;
  motion.lay(scan_from(start, room(), random), scanner(), {});
  // The wheels say that it stands, and are sure; it slides by 12 mm a scan.
  Pose2 pose;
  for (int i = 1; i <= 40; ++i) {
    const Pose2 truth{0.012 * i, 0.0, 0.003 * i};
    const ScanMove move = motion.lay(scan_from(start * truth, room(), random), scanner(),
                                     motion.predict({{}, covariance_of(1e-3, 1e-3)}));
    ASSERT_TRUE(move.is_found) << i;
    pose = move.frame_from_vehicle;
  }
  EXPECT_LT(error_of({0.48, 0.0, 0.12}, pose).norm(), 0.03);
}

/// The frame is a name: in another the same moves come out.
TEST(ScanMotion, TheFirstScanSetsTheFrame) {
  const Pose2 start{4.0, 3.0, 0.3};
  const auto drive = [&](const Pose2& first) {
    Random random(5);
    ScanMotion motion;
    const ScanMove begin = motion.lay(scan_from(start, room(), random), scanner(), {first});
    EXPECT_FALSE(begin.is_found);
    EXPECT_TRUE(begin.is_kept);
    std::vector<ScanMove> moves;
    Pose2 truth = start;
    for (int i = 0; i < 10; ++i) {
      truth = truth * Pose2{0.15, 0.01, 0.04};
      moves.push_back(motion.lay(scan_from(truth, room(), random), scanner(),
                                 motion.predict({{0.15, 0.0, 0.03}, covariance_of(0.02, 0.02)})));
    }
    return moves;
  };
  const Pose2 other{-30.0, 12.0, 2.2};
  const std::vector<ScanMove> one = drive({});
  const std::vector<ScanMove> two = drive(other);
  for (std::size_t i = 0; i < one.size(); ++i) {
    ASSERT_TRUE(one[i].is_found && two[i].is_found) << i;
    // Cells of the grids lie otherwise.
    EXPECT_LT(error_of(other * one[i].frame_from_vehicle, two[i].frame_from_vehicle).norm(), 0.01);
    EXPECT_LT(error_of(one[i].last_from_vehicle, two[i].last_from_vehicle).norm(), 0.01) << i;
    EXPECT_LT((one[i].move_information - two[i].move_information).norm(),
              0.2 * one[i].move_information.norm());
  }
}

TEST(ScanMotion, KeepsTheLastFew) {
  Random random(6);
  ScanMotionOptions options;
  options.local_keyframes = 3;
  ScanMotion motion(options);
  int kept = 0;
  const Pose2 start{2.0, 3.0, 0.0};
  for (int i = 0; i < 21; ++i) {
    const Pose2 truth{0.1 * i, 0.0, 0.0};
    const ScanMove move = motion.lay(scan_from(start * truth, room(), random), scanner(),
                                     {truth, covariance_of(0.01, 0.01)});
    kept += move.is_kept;
    EXPECT_EQ(motion.kept().size(), std::min<std::size_t>(3, static_cast<std::size_t>(kept)));
    if (move.is_kept) {
      EXPECT_EQ(motion.kept().back().frame_from_vehicle.x, move.frame_from_vehicle.x);
      EXPECT_EQ(motion.kept().back().beam_sigma_m, kNoise);
    }
  }
  EXPECT_EQ(kept, 6);  // at 0 and then every 0.4 m
  EXPECT_NEAR(motion.kept().front().frame_from_vehicle.x, 1.2, 0.03);
}

TEST(ScanMotion, NothingSeenIsNotFoundAndCarriedByThePrediction) {
  LaserScan blind;
  blind.first_bearing = -0.5 * kPi;
  blind.bearing_step = kPi / 180.0;
  blind.max_range = 20.0;
  blind.ranges.assign(181, 20.0);
  ScanMotion motion;
  for (int i = 0; i < 10; ++i) {
    const ScanMove move =
        motion.lay(blind, scanner(), motion.predict({{0.2 * i, 0.0, 0.0}, Matrix3d::Zero()}));
    EXPECT_FALSE(move.is_found);
    EXPECT_EQ(move.matched, 0);
    EXPECT_NEAR(move.frame_from_vehicle.x, 0.2 * i, 1e-12);
  }
}

TEST(ScanMotion, ThePredictionIsTheMoveInTheFrame) {
  Random random(7);
  ScanMotion motion;
  const Pose2 first{3.0, -2.0, 0.5 * kPi};
  motion.lay(scan_from({4.0, 3.0, 0.0}, room(), random), scanner(), {first});
  PoseWithCovariance move{{1.0, 0.0, 0.2}, Matrix3d::Zero()};
  move.covariance.diagonal() << 1.0, 4.0, 9.0;
  move.covariance(0, 2) = move.covariance(2, 0) = 0.5;
  const PoseWithCovariance predicted = motion.predict(move);
  EXPECT_NEAR(predicted.pose.x, 3.0, 1e-12);
  EXPECT_NEAR(predicted.pose.y, -1.0, 1e-12);
  EXPECT_NEAR(predicted.pose.theta, 0.5 * kPi + 0.2, 1e-12);
  Matrix3d expected;
  expected << 4.0, 0.0, 0.0, 0.0, 1.0, 0.5, 0.0, 0.5, 9.0;
  EXPECT_LT((predicted.covariance - expected).norm(), 1e-12);
}

}  // namespace
}  // namespace adit
