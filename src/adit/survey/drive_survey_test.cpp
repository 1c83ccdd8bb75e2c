#include "adit/survey/drive_survey.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "adit/simulation/ray_caster.hpp"
#include "adit/simulation/scanner.hpp"
#include "adit/simulation/timed_path.hpp"
#include "adit/simulation/world.hpp"

namespace adit {
namespace {

/// A gallery 2.4 m wide around a pillar of 16 m x 10 m, with niches at uneven distances.
std::vector<Segment> ring() {
  const std::vector<Vector2d> pillar = {{0, 0}, {0, 10}, {16, 10}, {16, 0}};
  const std::vector<Vector2d> around = {
      {-2.4, -2.4}, {3, -2.4},  {3, -3.4},    {4.2, -3.4}, {4.2, -2.4}, {11, -2.4}, {11, -4},
      {13, -4},     {13, -2.4}, {18.4, -2.4}, {18.4, 4},   {19.4, 4},   {19.4, 5},  {18.4, 5},
      {18.4, 12.4}, {9, 12.4},  {9, 13.2},    {7.5, 13.2}, {7.5, 12.4}, {2, 12.4},  {2, 14.5},
      {1, 14.5},    {1, 12.4},  {-2.4, 12.4}, {-2.4, 7},   {-3.6, 7},   {-3.6, 6},  {-2.4, 6}};
  std::vector<Segment> walls = outline(pillar);
  for (const Segment& s : outline(around)) walls.push_back(s);
  return walls;
}

/// One and a third rounds.
TimedPath rounds() {
  std::vector<Pose2> corners;
  const auto add = [&](double x, double y, double theta) { corners.push_back({x, y, theta}); };
  for (int round = 0; round < 2; ++round) {
    add(-1.2, -1.2, 0.0);
    add(17.2, -1.2, 0.0);
    add(17.2, -1.2, 0.5 * kPi);
    if (round == 1) break;
    add(17.2, 11.2, 0.5 * kPi);
    add(17.2, 11.2, kPi);
    add(-1.2, 11.2, kPi);
    add(-1.2, 11.2, -0.5 * kPi);
    add(-1.2, -1.2, -0.5 * kPi);
  }
  return drive_along(corners, 0.8, 0.6);
}

struct Drive {
  std::vector<LaserScan> scans;
  std::vector<Pose2> odometry;
  std::vector<Pose2> truth;
};

/// Dead reckoning that reports too much way and turns to one side: what averages do not cure.
Drive drive(const std::vector<Segment>& walls, const TimedPath& path, const ScannerSpec& scanner) {
  constexpr double kInterval = 0.25;  // s
  constexpr double kMoreWay = 1.04;
  constexpr double kTurns = 0.02;  // rad/m
  const RayCaster caster(walls);
  Random random(7);
  Drive out;
  for (double t = path.begin(); t <= path.end(); t += kInterval) {
    const Pose2 pose = path.at(t);
    LaserScan scan;
    scan.stamp = t;
    scan.first_bearing = scanner.first_bearing;
    scan.bearing_step = scanner.bearing_step;
    scan.max_range = scanner.model.max_range_m;
    for (int i = 0; i < scanner.beams; ++i) {
      const double bearing = pose.theta + scanner.first_bearing + i * scanner.bearing_step;
      const double range = caster.range(pose.translation(), unit_vector(bearing));
      scan.ranges.push_back(reported_range(range, scanner, random));
    }
    Pose2 odometry = pose;
    if (!out.truth.empty()) {
      Pose2 move = inverse(out.truth.back()) * pose;
      move.theta += kTurns * move.translation().norm();
      move.x *= kMoreWay;
      move.y *= kMoreWay;
      odometry = out.odometry.back() * move;
    }
    out.scans.push_back(std::move(scan));
    out.odometry.push_back(odometry);
    out.truth.push_back(pose);
  }
  return out;
}

DriveResult survey(const Drive& drive, const ScannerModel& scanner, int threads) {
  DriveSurvey survey({}, {});
  for (std::size_t i = 0; i < drive.scans.size(); ++i) {
    survey.add(drive.scans[i], scanner, drive.odometry[i]);
  }
  return survey.finish(threads, [](const char*, double) {}).value();
}

double worst_error_m(const Drive& drive, const std::vector<Pose2>& poses) {
  const Pose2 truth_from_map = drive.truth.front() * inverse(poses.front());
  double worst = 0.0;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const Pose2 pose = truth_from_map * poses[i];
    worst = std::max(worst, difference(drive.truth[i], pose).head<2>().norm());
  }
  return worst;
}

std::vector<Pose2> poses_of(const DriveResult& result) {
  std::vector<Pose2> poses;
  for (const SurveyedPose& pose : result.poses) poses.push_back(pose.map_from_vehicle);
  return poses;
}

TEST(DriveSurvey, ClosesALoopThatDeadReckoningLeavesOpen) {
  const ScannerSpec scanner = sick_lms();
  const Drive run = drive(ring(), rounds(), scanner);
  ASSERT_GT(worst_error_m(run, run.odometry), 3.0);
  const DriveResult result = survey(run, scanner.model, 2);
  ASSERT_EQ(result.poses.size(), run.scans.size());
  EXPECT_FALSE(result.closures.empty());
  EXPECT_LT(worst_error_m(run, poses_of(result)), 0.08);
  const Vector3d start = difference(run.odometry.front(), result.poses.front().map_from_vehicle);
  EXPECT_LT(start.norm(), 1e-9);
}

TEST(DriveSurvey, IsTheSameOnAnyNumberOfThreads) {
  const ScannerSpec scanner = sick_lms();
  const Drive run = drive(ring(), rounds(), scanner);
  const std::vector<Pose2> one = poses_of(survey(run, scanner.model, 1));
  const std::vector<Pose2> three = poses_of(survey(run, scanner.model, 3));
  ASSERT_EQ(one.size(), three.size());
  for (std::size_t i = 0; i < one.size(); ++i) {
    EXPECT_EQ(one[i].vector(), three[i].vector()) << "scan " << i;
  }
}

/// Between two keyframes, as many times as there are scans; in a map turned and moved against the
/// odometry.
TEST(DriveSurvey, TakesPlacesOfScansThatAreNoKeyframes) {
  const ScannerSpec scanner = sick_lms();
  const Drive run =
      drive(ring(), drive_along(std::vector<Pose2>{{-1.2, -1.2, 0.0}, {6.0, -1.2, 0.0}}, 0.2, 0.6),
            scanner);
  const Pose2 map_from_world{30.0, -20.0, 1.0};
  const std::vector<std::size_t> keyframes = survey(run, scanner.model, 1).keyframes;
  ASSERT_LT(keyframes.size(), run.scans.size());
  DriveSurvey survey({}, {});
  for (std::size_t i = 0; i < run.scans.size(); ++i) {
    survey.add(run.scans[i], scanner.model, run.odometry[i]);
  }
  for (std::size_t i = 0; i < run.scans.size(); ++i) {
    if (std::find(keyframes.begin(), keyframes.end(), i) != keyframes.end()) continue;
    survey.know_place(i, map_from_world * run.truth[i], 1e-4 * Matrix3d::Identity());
  }
  const auto finished = survey.finish(1);
  ASSERT_TRUE(finished.has_value());
  const DriveResult& result = *finished;
  for (std::size_t i = 0; i < run.scans.size(); ++i) {
    const Pose2 expected = map_from_world * run.truth[i];
    EXPECT_LT(difference(expected, result.poses[i].map_from_vehicle).norm(), 0.1) << "scan " << i;
  }
}

/// A few metres of gallery.
DriveSurvey begun() {
  const ScannerSpec scanner = sick_lms();
  const TimedPath path =
      drive_along(std::vector<Pose2>{{-1.2, -1.2, 0.0}, {3.0, -1.2, 0.0}}, 0.4, 0.6);
  const Drive run = drive(ring(), path, scanner);
  DriveSurvey survey({}, {});
  for (std::size_t i = 0; i < run.scans.size(); ++i) {
    survey.add(run.scans[i], scanner.model, run.odometry[i]);
  }
  return survey;
}

TEST(DriveSurvey, WhatFailsInsideIsAnError) {
  const auto full = [](const char*, double) { throw std::runtime_error("disk full"); };
  const auto result = begun().finish(2, full);
  ASSERT_FALSE(result.has_value());
  EXPECT_NE(result.error().message.find("disk full"), std::string::npos);
}

TEST(DriveSurvey, ASolutionThatFailsIsAnError) {
  DriveSurvey survey = begun();
  survey.know_place(0, {std::nan(""), 0.0, 0.0}, 1e-4 * Matrix3d::Identity());
  const auto result = survey.finish(1);
  ASSERT_FALSE(result.has_value());
  EXPECT_NE(result.error().message.find("cannot be solved"), std::string::npos);
}

}  // namespace
}  // namespace adit
