#include "adit/localizer/localizer.hpp"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "support/casting.hpp"

namespace adit {
namespace {

constexpr double kMaxRange = 30.0;

// A room that looks different from everywhere.
std::vector<Segment> room() {
  const std::vector<Vector2d> corners = {{0, 0}, {10, 0}, {10, 6}, {7, 6},
                                         {7, 9}, {3, 9},  {3, 7},  {0, 7}};
  std::vector<Segment> walls;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    walls.push_back({corners[i], corners[(i + 1) % corners.size()]});
  }
  return walls;
}

LocalizerSettings settings() {
  LocalizerSettings s;
  s.scanner.range_sigma_m = 0.005;
  s.scanner.quantisation_m = 0.01;
  s.scanner.max_range_m = kMaxRange;
  s.map.sigma_m = 0.0;
  return s;
}

// 720 beams in steps of 1 cm; the rounding is the only noise.
LaserScan scan_from(const LineMap& map, const Pose2& vehicle, double stamp,
                    const Pose2& mounting = {}) {
  LaserScan scan;
  scan.stamp = stamp;
  scan.first_bearing = -kPi;
  scan.bearing_step = kTwoPi / 720;
  scan.max_range = kMaxRange;
  scan.vehicle_from_laser = mounting;
  const Pose2 laser = vehicle * mounting;
  for (std::size_t beam = 0; beam < 720; ++beam) {
    const double range =
        testing::cast(map, laser.translation(), laser.theta + scan.bearing(beam), kMaxRange);
    scan.ranges.push_back(std::isfinite(range) ? 0.01 * std::round(100.0 * range) : kMaxRange);
  }
  return scan;
}

LaserScan blind_scan(double stamp) {
  LaserScan scan;
  scan.stamp = stamp;
  scan.first_bearing = -kPi;
  scan.bearing_step = kTwoPi / 720;
  scan.max_range = kMaxRange;
  scan.ranges.assign(720, kMaxRange);
  return scan;
}

// A drive through the room, what the wheels make of it (5 % too long, and turned on the way), and
// the scans of a laser mounted somewhere.
struct Drive {
  std::vector<Pose2> truth;
  std::vector<Pose2> odometry;
  std::vector<LaserScan> scans;
};

Drive drive_through(const LineMap& map, const Pose2& mounting = {}) {
  Drive drive;
  Pose2 odometry{};
  for (int i = 0; i < 14; ++i) {
    const double t = 0.4 * i;
    const Pose2 pose{2.0 + t, 2.5 + std::sin(0.8 * t), std::atan(0.8 * std::cos(0.8 * t))};
    if (!drive.truth.empty()) {
      Pose2 move = inverse(drive.truth.back()) * pose;
      move.x *= 1.05;
      move.theta += 0.004;
      odometry = odometry * move;
    }
    drive.truth.push_back(pose);
    drive.odometry.push_back(odometry);
    drive.scans.push_back(scan_from(map, pose, 100.0 + i, mounting));
  }
  return drive;
}

Pose2 rough_guess(const Pose2& truth) {
  return {truth.x + 0.15, truth.y - 0.1, truth.theta + 0.03};
}

double position_error(const Pose2& a, const Pose2& b) {
  return (a.translation() - b.translation()).norm();
}

void expect_near(const Pose2& a, const Pose2& b, double tolerance) {
  EXPECT_NEAR(a.x, b.x, tolerance);
  EXPECT_NEAR(a.y, b.y, tolerance);
  EXPECT_NEAR(angle_between(a.theta, b.theta), 0.0, tolerance);
}

class LocalizerTest : public ::testing::Test {
 protected:
  std::vector<Estimate> run(const Drive& along, const LocalizerSettings& with = settings()) {
    Localizer localizer(map, with);
    localizer.start(rough_guess(along.truth.front()));
    std::vector<Estimate> estimates;
    for (std::size_t i = 0; i < along.scans.size(); ++i) {
      estimates.push_back(localizer.update(along.scans[i], along.odometry[i]));
      estimates.back().pairs = {};  // a view of buffers that go with the localizer
    }
    return estimates;
  }
  const LineMap map = LineMap::build(room());
  const Drive drive = drive_through(map);
};

TEST_F(LocalizerTest, FollowsTheVehicle) {
  const auto estimates = run(drive);
  for (std::size_t i = 0; i < estimates.size(); ++i) {
    const Estimate& e = estimates[i];
    SCOPED_TRACE(i);
    EXPECT_EQ(e.stamp, drive.scans[i].stamp);
    EXPECT_EQ(e.status, Status::ok);
    EXPECT_FALSE(e.dead_reckoned);
    EXPECT_LT(position_error(e.pose, drive.truth[i]), 0.01);
    EXPECT_NEAR(angle_between(e.pose.theta, drive.truth[i].theta), 0.0, radians(0.2));
    EXPECT_TRUE(e.covariance.isApprox(e.covariance.transpose(), 1e-9));
    EXPECT_EQ(Eigen::LLT<Matrix3d>(e.covariance).info(), Eigen::Success);
    EXPECT_LT(e.covariance(0, 0) + e.covariance(1, 1), 0.02 * 0.02);
  }
}

TEST_F(LocalizerTest, AScanThatCannotBeUsedGivesADeadReckonedPoseThatSaysSo) {
  LaserScan without_beams = blind_scan(102.0);
  without_beams.ranges.clear();
  LaserScan not_a_number = blind_scan(102.0);
  std::fill(not_a_number.ranges.begin(), not_a_number.ranges.end(),
            std::numeric_limits<double>::quiet_NaN());
  LaserScan two_beams = blind_scan(102.0);
  two_beams.ranges[10] = 2.0;
  two_beams.ranges[300] = 3.0;
  for (const LaserScan& useless : {blind_scan(102.0), without_beams, not_a_number, two_beams}) {
    Localizer localizer(map, settings());
    localizer.start(rough_guess(drive.truth[0]));
    localizer.update(drive.scans[0], drive.odometry[0]);
    const Estimate before = localizer.update(drive.scans[1], drive.odometry[1]);
    ASSERT_EQ(before.status, Status::ok);
    const Pose2 move{0.8, 0.1, 0.3};
    const Estimate& after = localizer.update(useless, drive.odometry[1] * move);
    EXPECT_EQ(after.stamp, 102.0);
    EXPECT_EQ(after.status, Status::lost);
    EXPECT_TRUE(after.dead_reckoned);
    EXPECT_TRUE(after.pairs.empty());
    expect_near(after.pose, before.pose * move, 1e-12);
    const auto growth = dead_reckon({before.pose, before.covariance}, move, settings().odometry);
    EXPECT_TRUE(after.covariance.isApprox(growth.covariance, 1e-9)) << after.covariance;
    EXPECT_GT(after.covariance(2, 2), before.covariance(2, 2));
  }
}

TEST_F(LocalizerTest, RecoversAfterScansThatCannotBeUsed) {
  Localizer localizer(map, settings());
  localizer.start(rough_guess(drive.truth[0]));
  for (std::size_t i = 0; i < drive.scans.size(); ++i) {
    const bool blind = i >= 3 && i < 8;
    const LaserScan& scan = blind ? blind_scan(drive.scans[i].stamp) : drive.scans[i];
    const Estimate& e = localizer.update(scan, drive.odometry[i]);
    EXPECT_EQ(e.status, blind ? Status::lost : Status::ok) << i;
    EXPECT_LT(position_error(e.pose, drive.truth[i]), blind ? 0.3 : 0.01) << i;
  }
}

TEST_F(LocalizerTest, OddOdometryAndMountingsCostTheirScanAndNoOther) {
  Localizer localizer(map, settings());
  localizer.start(rough_guess(drive.truth[0]));
  const double nan = std::nan("");
  for (std::size_t i = 0; i < drive.scans.size(); ++i) {
    LaserScan scan = drive.scans[i];
    Pose2 odometry = drive.odometry[i];
    if (i == 3) odometry.x = nan;
    if (i == 5) scan.vehicle_from_laser.theta = nan;
    const Estimate& e = localizer.update(scan, odometry);
    const bool odd = i == 3 || i == 5;
    EXPECT_EQ(e.status, odd ? Status::lost : Status::ok) << i;
    EXPECT_EQ(e.dead_reckoned, odd) << i;
    EXPECT_TRUE(e.pose.is_finite() && e.covariance.allFinite()) << i;
    if (!odd) {
      EXPECT_LT(position_error(e.pose, drive.truth[i]), 0.01) << i;
    }
  }
}

TEST_F(LocalizerTest, AGyroThatFallsSilentLeavesTheTurnToTheWheels) {
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
      EXPECT_NEAR(angle_between(heading, localizer.predicted().pose.theta), move.theta, 1e-9) << i;
    }
    heading = localizer.estimate().pose.theta;
  }
}

TEST_F(LocalizerTest, AScanOfAnotherPlaceIsRefused) {
  const std::vector<Segment> triangle = {{{0, 0}, {12, 1}}, {{12, 1}, {3, 13}}, {{3, 13}, {0, 0}}};
  const LineMap elsewhere = LineMap::build(triangle);
  Localizer localizer(map, settings());
  localizer.start(drive.truth[0]);
  localizer.update(drive.scans[0], drive.odometry[0]);
  const Estimate& e =
      localizer.update(scan_from(elsewhere, drive.truth[1], 101.0), drive.odometry[1]);
  EXPECT_EQ(e.status, Status::lost);
}

/// Two halls that are alike but for a wall across the second.
std::vector<Segment> two_halls() {
  const auto hall = [](double x, double length) {
    const Vector2d a(x, 0), b(x + length, 0), c(x + length, 9), d(x, 9), e(x, 6), f(x + 1, 6),
        g(x + 1, 5), h(x, 5);
    return std::vector<Segment>{{a, b}, {b, c}, {c, d}, {d, e}, {e, f}, {f, g}, {g, h}, {h, a}};
  };
  std::vector<Segment> plan = hall(0.0, 20.0);
  for (const Segment& wall : hall(50.0, 4.5)) plan.push_back(wall);
  return plan;
}

TEST_F(LocalizerTest, APoseThatExplainsLittleIsDoubtedWhereAnotherExplainsMuch) {
  const LineMap halls = LineMap::build(two_halls());
  const auto status_after = [&](const Pose2& truth, double doubtful_evidence_ratio) {
    LocalizerSettings with = settings();
    with.recovery.doubtful_evidence_ratio = doubtful_evidence_ratio;
    Localizer localizer(halls, with);
    localizer.start({3.0, 4.0, 0.1});
    Status status = Status::lost;
    for (int i = 0; i < 8; ++i) {
      status = localizer.update(scan_from(halls, truth, 100.0 + i), Pose2{}).status;
    }
    return status;
  };
  // From the second hall's place, what is missing of the first may be hidden by clutter.
  const Pose2 second{53.0, 4.0, 0.1};
  EXPECT_EQ(status_after(second, 0.0), Status::ok);
  EXPECT_EQ(status_after(second, 0.9), Status::ambiguous);
  EXPECT_EQ(status_after({3.0, 4.0, 0.1}, 0.9), Status::ok);
}

TEST_F(LocalizerTest, TheGyroReplacesTheRotationOfTheWheels) {
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

TEST_F(LocalizerTest, TheGyroIsReadAtTheStampOfTheScan) {
  Localizer localizer(map, settings());
  localizer.start(drive.truth[0]);
  for (int i = 0; i <= 20; ++i) localizer.add_gyro(100.0 + 0.1 * i, 3.0 + 0.05 * i);
  const Estimate before = localizer.update(drive.scans[0], Pose2{});
  const Estimate& after = localizer.update(blind_scan(101.25), Pose2{});
  EXPECT_NEAR(angle_between(before.pose.theta, after.pose.theta), 0.625, 1e-9);
}

TEST_F(LocalizerTest, AMountedLaserGivesThePoseOfTheVehicle) {
  const Pose2 mounting{0.9, -0.3, 0.7};
  const auto estimates = run(drive_through(map, mounting));
  for (std::size_t i = 0; i < estimates.size(); ++i) {
    EXPECT_EQ(estimates[i].status, Status::ok) << i;
    EXPECT_LT(position_error(estimates[i].pose, drive.truth[i]), 0.015) << i;
    EXPECT_NEAR(angle_between(estimates[i].pose.theta, drive.truth[i].theta), 0.0, radians(0.3));
  }
}

TEST_F(LocalizerTest, TheSameCallsGiveTheSameBits) {
  const auto one = run(drive);
  const auto other = run(drive);
  for (std::size_t i = 0; i < one.size(); ++i) {
    EXPECT_EQ(one[i].pose.vector(), other[i].pose.vector());
    EXPECT_EQ(one[i].covariance, other[i].covariance);
    EXPECT_EQ(one[i].chi_square, other[i].chi_square);
  }
}

TEST_F(LocalizerTest, StartingAgainForgetsEverything) {
  const auto fresh = run(drive);
  Localizer localizer(map, settings());
  localizer.start({5.0, 5.0, 1.0});
  for (int i = 0; i < 5; ++i) localizer.update(drive.scans[9], drive.odometry[3]);
  localizer.start(rough_guess(drive.truth[0]));
  for (std::size_t i = 0; i < drive.scans.size(); ++i) {
    const Estimate& e = localizer.update(drive.scans[i], drive.odometry[i]);
    EXPECT_EQ(e.pose.vector(), fresh[i].pose.vector()) << i;
    EXPECT_EQ(e.covariance, fresh[i].covariance) << i;
  }
}

TEST_F(LocalizerTest, OnlyDifferencesOfTheOdometryCount) {
  const auto expected = run(drive);
  Drive moved = drive;
  for (Pose2& pose : moved.odometry) pose = Pose2{-40.0, 17.0, 2.5} * pose;
  const auto estimates = run(moved);
  for (std::size_t i = 0; i < expected.size(); ++i) {
    expect_near(estimates[i].pose, expected[i].pose, 1e-9);
    EXPECT_TRUE(estimates[i].covariance.isApprox(expected[i].covariance, 1e-6));
  }
}

TEST_F(LocalizerTest, OdometryMayComeInAnyOrderAndTwice) {
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

TEST_F(LocalizerTest, ScansWithEarlierOrRepeatedStampsAreAnsweredInTheOrderOfTheLog) {
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

TEST_F(LocalizerTest, WithoutOdometryAStandingVehicleIsFollowed) {
  Localizer localizer(map, settings());
  localizer.start(rough_guess(drive.truth[0]));
  for (int i = 0; i < 3; ++i) {
    const Estimate& e = localizer.update(drive.scans[0]);
    EXPECT_EQ(e.status, Status::ok);
    EXPECT_LT(position_error(e.pose, drive.truth[0]), 0.01);
  }
}

TEST_F(LocalizerTest, NothingIsKnownInAnEmptyMap) {
  const LineMap nothing;
  Localizer localizer(nothing, settings());
  localizer.start(drive.truth[0]);
  for (std::size_t i = 0; i < 3; ++i) {
    const Estimate& e = localizer.update(drive.scans[i], drive.odometry[i]);
    EXPECT_EQ(e.status, Status::lost);
    EXPECT_TRUE(e.dead_reckoned);
    expect_near(e.pose, drive.truth[0] * (inverse(drive.odometry[0]) * drive.odometry[i]), 1e-12);
  }
}

TEST_F(LocalizerTest, TheErrorThatThePlanSharesStandsBesideTheFilter) {
  LocalizerSettings rough = settings();
  rough.estimator = Estimator::features;
  rough.map.sigma_m = 0.2;
  rough.belief.map_stretch_m = 4.0;
  for (const Estimate& e : run(drive, rough)) {
    EXPECT_GT(e.covariance(0, 0), 0.2 * 0.2);
    EXPECT_GT(e.covariance(1, 1), 0.2 * 0.2);
    EXPECT_GT(e.covariance(2, 2), 0.05 * 0.05);
    EXPECT_LT(e.covariance(0, 0), 0.3 * 0.3);
  }
}

}  // namespace
}  // namespace adit
