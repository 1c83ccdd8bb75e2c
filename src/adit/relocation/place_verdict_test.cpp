#include "adit/relocation/place_verdict.hpp"

#include <gtest/gtest.h>

#include <functional>

namespace adit {
namespace {

constexpr std::size_t kPlaces = 100000;

/// A scan of so much of a turn, all of it on walls.
LaserScan scan_of(double turn_rad) {
  LaserScan scan;
  scan.first_bearing = -0.5 * turn_rad;
  scan.bearing_step = radians(1.0);
  scan.max_range = 40.0;
  scan.ranges.assign(static_cast<std::size_t>(turn_rad / scan.bearing_step), 5.0);
  return scan;
}

RankedPose pose_at(double x, double weight) {
  RankedPose pose;
  pose.pose = {x, 0.0, 0.0};
  pose.covariance = Vector3d(1e-4, 1e-4, 1e-6).asDiagonal();
  pose.weight = weight;
  pose.quality = {.converged = true,
                  .evidence_ratio = 1.0,
                  .returns = 300.0,
                  .wall_ratio = 0.9,
                  .behind_ratio = 0.0};
  return pose;
}

/// One pose, twelve lines, a plan without error, all explained, a lead of so much.
RelocationResult one_pose(double gap) {
  RelocationResult found;
  found.poses = {pose_at(0.0, 1.0)};
  found.gap = gap;
  found.lines = 12;
  found.map_error = {0.0125, 2.0, 0.0};  // the least that a search looks for
  return found;
}

Status judge(const RelocationResult& found, const LaserScan& scan = scan_of(kTwoPi),
             std::size_t places = kPlaces) {
  const ScannerModel scanner{.max_range_m = 40.0, .min_range_m = 0.1};
  const MapError stated{0.1, 2.0, 0.0};
  return judge_place(found, {scan, scanner, stated, {}, {}}, places, {}, {});
}

TEST(PlaceVerdict, OnePoseThatLeadsIsThePlace) {
  EXPECT_EQ(judge(one_pose(4.0)), Status::ok);
  EXPECT_EQ(judge(one_pose(1.2)), Status::ambiguous);
}

TEST(PlaceVerdict, NoPoseOrOneThatExplainsNothingIsLost) {
  EXPECT_EQ(judge(RelocationResult{}), Status::lost);
  RelocationResult found = one_pose(100.0);
  found.poses.front().quality.evidence_ratio = 0.05;
  EXPECT_EQ(judge(found), Status::lost);
}

TEST(PlaceVerdict, APoseThatIsOpenInADirectionIsDegraded) {
  RelocationResult found = one_pose(100.0);
  found.poses.front().covariance(0, 0) = 1.0;
  EXPECT_EQ(judge(found), Status::degraded);
}

TEST(PlaceVerdict, RivalsOfWeightMakeItAmbiguousOthersDoNot) {
  RelocationResult found = one_pose(100.0);
  found.poses.push_back(pose_at(20.0, 0.05));
  EXPECT_EQ(judge(found), Status::ambiguous);
  found.poses.back().weight = 0.001;
  EXPECT_EQ(judge(found), Status::ok);
  found.poses.back() = pose_at(0.3, 0.05);
  EXPECT_EQ(judge(found), Status::ok) << "the same place";
  found.poses.back().pose.theta = radians(4.0);
  EXPECT_EQ(judge(found), Status::ambiguous) << "the same place, turned";
}

/// A lead that is enough for a scan that speaks for itself is not where chance has more room.
TEST(PlaceVerdict, WhatSpeaksForChanceAsksForALongerLead) {
  const std::function<void(RelocationResult&)> doubts[] = {
      [](RelocationResult& found) { found.lines = 3; },
      [](RelocationResult& found) { found.shares.through = 0.03; },
      [](RelocationResult& found) { found.shares.unmapped = 0.03; },
      [](RelocationResult& found) { found.shares.missing = 0.15; },
      [](RelocationResult& found) { found.poses.front().quality.behind_ratio = 0.05; },
      [](RelocationResult& found) { found.poses.front().quality.evidence_ratio = 0.85; },
      [](RelocationResult& found) {
        found.map_error = {0.05, 2.0, 0.0};
      },
  };
  for (const auto& doubt : doubts) {
    RelocationResult found = one_pose(4.0);
    doubt(found);
    EXPECT_EQ(judge(found), Status::ambiguous) << &doubt - doubts;
    found.gap = 12.0;
    EXPECT_EQ(judge(found), Status::ok) << &doubt - doubts;
  }
}

TEST(PlaceVerdict, ALargeMineAsksForALongerLead) {
  EXPECT_EQ(judge(one_pose(3.0), scan_of(kTwoPi), 1000), Status::ok);
  EXPECT_EQ(judge(one_pose(3.0), scan_of(kTwoPi), 2000000), Status::ambiguous);
  EXPECT_EQ(judge(one_pose(12.0), scan_of(kTwoPi), 2000000), Status::ok);
}

TEST(PlaceVerdict, AScanOfLessOfATurnAsksForALongerLead) {
  EXPECT_EQ(judge(one_pose(6.0), scan_of(kPi)), Status::ambiguous);
  EXPECT_EQ(judge(one_pose(20.0), scan_of(kPi)), Status::ok);
}

TEST(PlaceVerdict, TurnInSightCountsBearingsWithReturns) {
  const ScannerModel scanner{.max_range_m = 40.0, .min_range_m = 0.1};
  EXPECT_NEAR(turn_in_sight(scan_of(kTwoPi), scanner), 1.0, 0.02);
  EXPECT_NEAR(turn_in_sight(scan_of(1.5 * kPi), scanner), 0.75, 0.02);
  LaserScan scan = scan_of(kTwoPi);
  for (std::size_t i = 0; i < 90; ++i) scan.ranges[i] = scan.max_range;
  EXPECT_NEAR(turn_in_sight(scan, scanner), 0.75, 0.02);
  LaserScan sparse = scan_of(kTwoPi);
  sparse.bearing_step = radians(12.0);
  sparse.ranges.resize(30);
  EXPECT_NEAR(turn_in_sight(sparse, scanner), 1.0, 0.01);
}

}  // namespace
}  // namespace adit
