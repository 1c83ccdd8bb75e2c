#include "adit/survey/wall_hits.hpp"

#include <gtest/gtest.h>

#include "adit/simulation/scanner.hpp"
#include "adit/simulation/world.hpp"

namespace adit {
namespace {

PosedScan scan_of(const std::vector<Segment>& walls, const Pose2& pose) {
  Random random(1);
  return {simulate_scan(RayCaster(walls), pose, sick(), random), pose, Matrix3d::Zero()};
}

TEST(WallHitFinder, GivesNormalsTowardsTheScanner) {
  const std::vector<Segment> walls{{{-5.0, 3.0}, {5.0, 3.0}}};
  WallHitFinder finder(sick().model, {});
  const auto& hits = finder.find(scan_of(walls, {0.0, 0.0, 1.2}));
  ASSERT_GT(hits.size(), 100u);
  for (const WallHit& hit : hits) {
    EXPECT_NEAR(hit.point.y(), 3.0, 0.1);
    EXPECT_LT(hit.normal.y(), -0.9);
  }
}

TEST(WallHitFinder, LeavesOutBeamsWithoutNeighbours) {
  // A post one beam wide far before nothing.
  const std::vector<Segment> post{{{4.0, -0.01}, {4.0, 0.01}}};
  WallHitFinder finder(sick().model, {});
  EXPECT_TRUE(finder.find(scan_of(post, {0.0, 0.0, 0.0})).empty());
}

TEST(WallHitFinder, CountsTheHeadingsErrorMoreTheFartherTheWall) {
  const std::vector<Segment> walls{{{-20.0, 3.0}, {20.0, 3.0}}};
  PosedScan posed = scan_of(walls, {0.0, 0.0, 1.2});
  posed.covariance(2, 2) = 1e-4;
  WallHitFinder finder(sick().model, {});
  double near = 0.0, far = 0.0;
  for (const WallHit& hit : finder.find(posed)) {
    if (std::abs(hit.point.x()) < 0.5) near = std::max(near, hit.pose_variance);
    if (hit.point.x() > 8.0) far = std::max(far, hit.pose_variance);
  }
  EXPECT_GT(near, 0.0);
  EXPECT_GT(far, 0.5 * 64.0 * 1e-4);
  EXPECT_LT(near, 0.1 * far);
}

/// A short piece of wall, seen flat from afar: two beams of each scan end on it.
std::vector<PosedScan> scans_of_a_far_bump(int count) {
  const std::vector<Segment> bump{{{20.0, 3.0}, {20.8, 3.0}}};
  std::vector<PosedScan> scans;
  for (int i = 0; i < count; ++i) {
    scans.push_back(scan_of(bump, {0.0, 0.0, radians(0.09 * i)}));
  }
  return scans;
}

std::size_t count_hits(PlaceHitFinder& finder, const std::vector<PosedScan>& scans) {
  std::size_t count = 0;
  for (const std::vector<WallHit>& hits : finder.find(scans)) {
    for (const WallHit& hit : hits) EXPECT_GT(std::abs(hit.normal.y()), 0.9);
    count += hits.size();
  }
  return count;
}

TEST(PlaceHitFinder, FindsNeighboursInTheOtherScansOfThePlace) {
  PlaceHitFinder finder(sick().model, {});
  EXPECT_EQ(count_hits(finder, scans_of_a_far_bump(1)), 0u);
  EXPECT_GT(count_hits(finder, scans_of_a_far_bump(8)), 0u);
}

TEST(PlaceHitFinder, MakesNoWallOfAPost) {
  const std::vector<Segment> post{{{4.0, -0.01}, {4.0, 0.01}}};
  std::vector<PosedScan> scans;
  for (int i = 0; i < 8; ++i) {
    Random random(static_cast<std::uint64_t>(i));
    const Pose2 pose{0.0, 0.0, 0.0};
    scans.push_back({simulate_scan(RayCaster(post), pose, sick(), random), pose, Matrix3d::Zero()});
  }
  WallHitFinder alone(sick().model, {});
  alone.find(scans.front());
  EXPECT_FALSE(alone.lone().empty());
  PlaceHitFinder finder(sick().model, {});
  std::size_t count = 0;
  for (const std::vector<WallHit>& hits : finder.find(scans)) count += hits.size();
  EXPECT_EQ(count, 0u);
}

}  // namespace
}  // namespace adit
