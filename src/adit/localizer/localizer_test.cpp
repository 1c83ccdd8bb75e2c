#include "adit/localizer/localizer.hpp"

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

class LocalizerTest : public RoomDrive {};

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

TEST_F(LocalizerTest, ThePlansLongErrorStandsInCovarianceAndLevel) {
  // 3.72 sigma on a circle are exceeded once in a thousand.
  LocalizerSettings bent = settings();
  bent.map.sigma_m = 0.2;
  for (const Estimate& e : run(drive, bent)) {
    EXPECT_GT(e.covariance(0, 0), 0.2 * 0.2);
    EXPECT_GT(e.covariance(1, 1), 0.2 * 0.2);
    EXPECT_LT(e.covariance(0, 0), 0.25 * 0.25);
    EXPECT_GT(e.covariance(2, 2), std::pow(0.2 / 16.0, 2));
    EXPECT_GT(e.protection_m, 3.71 * 0.2);
    EXPECT_LT(e.protection_m, 3.71 * 0.2 + 0.3);
  }
  for (const Estimate& e : run(drive)) EXPECT_LT(e.protection_m, 0.3);  // exact, and stated so
}

TEST_F(LocalizerTest, FeaturesAreMatchedOnTheWayWhereThePlanHasWallsTwice) {
  std::vector<Segment> walls = room();
  for (const Segment& wall : room()) {  // once more, 5 cm farther in
    const Vector2d in = 0.05 * perpendicular(Vector2d((wall.b - wall.a).normalized()));
    walls.push_back({wall.a + in, wall.b + in});
  }
  const LineMap doubled = LineMap::build(walls);
  LocalizerSettings with = settings();
  with.map.sigma_m = 0.03;
  const auto scans_with_features = [&](const LineMap& plan) {
    Localizer localizer(plan, with);
    localizer.start(drive.truth.front());
    int count = 0;
    for (std::size_t i = 0; i < drive.scans.size(); ++i) {
      EXPECT_EQ(localizer.update(drive.scans[i], drive.odometry[i]).status, Status::ok);
      count += !localizer.last_turn().match.pairs.empty();
    }
    return count;
  };
  EXPECT_LE(scans_with_features(map), 2);
  EXPECT_GE(scans_with_features(doubled), 10);
}

}  // namespace
}  // namespace adit
