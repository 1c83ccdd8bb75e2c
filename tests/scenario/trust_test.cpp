// What the localizer says of its own answers: statuses, protection, and how it takes odd input.

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "adit/localizer/localizer.hpp"
#include "adit/simulation/mine_worlds.hpp"
#include "adit/simulation/vehicle.hpp"
#include "adit/simulation/world.hpp"

namespace adit {
namespace {

LocalizerSettings settings_for(const ScannerSpec& spec, double map_sigma_m) {
  LocalizerSettings settings;
  settings.scanner = spec.model;
  settings.odometry = mockup_odometry();
  settings.map.sigma_m = map_sigma_m;
  return settings;
}

double position_error(const Estimate& e, const Pose2& truth) {
  return (e.pose.translation() - truth.translation()).norm();
}

struct Mockup {
  explicit Mockup(std::uint64_t seed) {
    recording = record_stops(world, mockup_path(), cyclone(), {}, seed);
  }
  World world = mockup();
  LineMap map = LineMap::build(world.plan);
  Recording recording;
};

TEST(Trust, TheMockupIsAnsweredOkWithALevelThatHolds) {
  const Mockup run(21);
  Localizer localizer(run.map, settings_for(cyclone(), 0.0));
  localizer.start(run.recording.first_guess.pose, run.recording.first_guess.covariance);
  int tight = 0;
  for (std::size_t i = 0; i < run.recording.scans.size(); ++i) {
    const Estimate& e = localizer.update(run.recording.scans[i], run.recording.odometry[i]);
    EXPECT_EQ(e.status, Status::ok) << i;
    EXPECT_FALSE(e.open_direction) << i;
    EXPECT_LT(position_error(e, run.recording.truth[i].pose), e.protection_m) << i;
    tight += e.protection_m < 0.15 ? 1 : 0;  // not where the wheels erred beyond 1e-3
  }
  EXPECT_GE(tight, 14);
}

// Two endless walls: nothing shows the way along them.
TEST(Trust, AlongAStraightDriftThePoseIsDegradedAndSaysWhere) {
  const std::vector<Segment> plan = {{{-300, -2.5}, {300, -2.5}}, {{-300, 2.5}, {300, 2.5}}};
  const World world = from_plan(plan);
  const LineMap map = LineMap::build(plan);
  const RayCaster caster(world.walls);
  Random random(3);
  Localizer localizer(map, settings_for(cyclone(), 0.0));
  localizer.start({0.1, 0.1, 0.02});
  double last_variance = 0.0;
  for (int i = 0; i < 10; ++i) {
    const Pose2 truth{1.6 * i, 0.0, 0.0};
    LaserScan scan = simulate_scan(caster, truth, cyclone(), random);
    scan.stamp = i;
    const Estimate& e = localizer.update(scan, truth);
    EXPECT_EQ(e.status, Status::degraded);
    ASSERT_TRUE(e.open_direction);
    EXPECT_NEAR(std::abs(e.open_direction->x()), 1.0, 1e-3);
    EXPECT_LT(std::abs(e.pose.y), 0.03);
    EXPECT_GT(e.covariance(0, 0), last_variance);  // dead reckoning alone, and it says so
    EXPECT_LT(e.covariance(1, 1), 0.02 * 0.02);
    last_variance = e.covariance(0, 0);
  }
}

TEST(Trust, AfterAKidnappingNothingIsOkAtTheWrongPlace) {
  const Mockup run(22);
  Localizer localizer(run.map, settings_for(cyclone(), 0.0));
  localizer.start(run.recording.first_guess.pose, run.recording.first_guess.covariance);
  for (std::size_t i = 0; i < 4; ++i) {
    localizer.update(run.recording.scans[i], run.recording.odometry[i]);
  }
  int wrong = 0;
  for (std::size_t i = 4; i < 8; ++i) {  // the wheels go on, the vehicle is eight stops ahead
    const Estimate& e = localizer.update(run.recording.scans[i + 8], run.recording.odometry[i]);
    const double error = position_error(e, run.recording.truth[i + 8].pose);
    wrong += error > 1.0 && (e.status == Status::ok || e.status == Status::degraded) ? 1 : 0;
    if (e.status == Status::lost) {
      EXPECT_TRUE(std::isinf(e.protection_m));
    }
  }
  EXPECT_EQ(wrong, 0);
}

TEST(Trust, ABlindScanIsLostAndTheNextOneIsOkAgain) {
  const Mockup run(23);
  Localizer localizer(run.map, settings_for(cyclone(), 0.0));
  localizer.start(run.recording.first_guess.pose, run.recording.first_guess.covariance);
  localizer.update(run.recording.scans[0], run.recording.odometry[0]);
  LaserScan blind = run.recording.scans[1];
  blind.ranges.assign(blind.ranges.size(), std::numeric_limits<double>::infinity());
  EXPECT_EQ(localizer.update(blind, run.recording.odometry[1]).status, Status::lost);
  EXPECT_EQ(localizer.update(run.recording.scans[2], run.recording.odometry[2]).status, Status::ok);
}

TEST(Trust, WithoutOdometryTheVarianceGrowsWithTime) {
  const Mockup run(24);
  Localizer localizer(run.map, settings_for(cyclone(), 0.0));
  localizer.start(run.recording.truth[0].pose);
  LaserScan blind = run.recording.scans[0];
  blind.ranges.assign(blind.ranges.size(), std::numeric_limits<double>::infinity());
  blind.stamp = 10.0;
  const double before = localizer.update(blind).covariance(0, 0);
  blind.stamp = 12.0;
  const double after = localizer.update(blind).covariance(0, 0);
  const double speed = LocalizerOptions{}.unknown_speed_m_per_s;
  EXPECT_NEAR(after - before, 4.0 * speed * speed, 1e-9);
}

TEST(Trust, AScanThatComesTwiceSaysNothingNew) {
  const Mockup run(25);
  Localizer localizer(run.map, settings_for(cyclone(), 0.0));
  localizer.start(run.recording.first_guess.pose, run.recording.first_guess.covariance);
  const Estimate once = localizer.update(run.recording.scans[0], run.recording.odometry[0]);
  for (int i = 0; i < 5; ++i) {
    const Estimate& again = localizer.update(run.recording.scans[0], run.recording.odometry[0]);
    EXPECT_EQ(again.pose.vector(), once.pose.vector());
    EXPECT_EQ(again.covariance, once.covariance);
  }
  EXPECT_EQ(localizer.last_turn().stamps.duplicates, 5);
}

TEST(Trust, LateStampsGapsAndJumpsAreCounted) {
  const Mockup run(26);
  Localizer localizer(run.map, settings_for(cyclone(), 0.0));
  localizer.start(run.recording.first_guess.pose, run.recording.first_guess.covariance);
  const double stamps[] = {0.0, 1.0, 0.5, 30.0, 1e6, 1e6 + 1.0};
  for (std::size_t i = 0; i < 6; ++i) {
    LaserScan scan = run.recording.scans[i];
    scan.stamp = stamps[i];
    const Estimate& e = localizer.update(scan, run.recording.odometry[i]);
    EXPECT_EQ(e.status, Status::ok) << i;
    EXPECT_LT(position_error(e, run.recording.truth[i].pose), 0.05) << i;
  }
  EXPECT_EQ(localizer.last_turn().stamps.late, 1);
  EXPECT_EQ(localizer.last_turn().stamps.gaps, 1);
  EXPECT_EQ(localizer.last_turn().stamps.jumps, 1);
}

// A scanner ahead and one astern, of other noise, with stamps of their own.
TEST(Trust, SeveralScannersOnOneVehicle) {
  const World world = mockup();
  const LineMap map = LineMap::build(world.plan);
  const RayCaster caster(world.walls);
  ScannerSpec front = sick_lms();
  front.vehicle_from_laser = {1.2, 0.0, 0.0};
  ScannerSpec rear = hokuyo();
  rear.vehicle_from_laser = {-0.8, 0.1, kPi};
  LocalizerSettings settings = settings_for(front, 0.0);
  settings.more_scanners = {rear.model};
  Localizer localizer(map, settings);
  const std::vector<Pose2> path = mockup_path();
  localizer.start(path[0]);
  Random random(9);
  for (std::size_t i = 0; i < path.size(); ++i) {
    for (const int which : {0, 1}) {
      LaserScan scan = simulate_scan(caster, path[i], which == 0 ? front : rear, random);
      scan.stamp = 3.0 * static_cast<double>(i) + 0.01 * which;
      scan.scanner = which;
      const Estimate& e = localizer.update(scan, path[i]);
      EXPECT_NE(e.status, Status::lost) << i << ' ' << which;
      EXPECT_LT(position_error(e, path[i]), 0.03) << i << ' ' << which;
    }
  }
}

TEST(Trust, PointsAloneFollowAsWell) {
  const Mockup run(27);
  LocalizerSettings settings = settings_for(cyclone(), 0.0);
  settings.estimator = Estimator::points;
  Localizer localizer(run.map, settings);
  localizer.start(run.recording.first_guess.pose, run.recording.first_guess.covariance);
  for (std::size_t i = 0; i < run.recording.scans.size(); ++i) {
    const Estimate& e = localizer.update(run.recording.scans[i], run.recording.odometry[i]);
    EXPECT_LT(position_error(e, run.recording.truth[i].pose), 0.05) << i;
    EXPECT_TRUE(e.pairs.empty());
  }
}

}  // namespace
}  // namespace adit
