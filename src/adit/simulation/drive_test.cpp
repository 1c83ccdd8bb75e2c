#include "adit/simulation/drive.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <numeric>

#include "adit/simulation/mine_worlds.hpp"
#include "adit/simulation/world.hpp"
#include "support/repeats.hpp"

namespace adit {
namespace {

/// A room of 40 x 30 m round a pillar, with a dead-end drift 3 m wide and 20 m long at its right.
std::vector<Segment> pillar_and_drift() {
  std::vector<Segment> walls = outline(std::vector<Vector2d>{
      {0, 0}, {40, 0}, {40, 4}, {60, 4}, {60, 7}, {40, 7}, {40, 30}, {0, 30}});
  const std::vector<Segment> pillar =
      outline(std::vector<Vector2d>{{6, 6}, {34, 6}, {34, 24}, {6, 24}});
  walls.insert(walls.end(), pillar.begin(), pillar.end());
  return walls;
}

bool is_in_openings(const Vector2d& p) {
  const bool room = p.x() > 0 && p.x() < 40 && p.y() > 0 && p.y() < 30;
  const bool pillar = p.x() > 6 && p.x() < 34 && p.y() > 6 && p.y() < 24;
  const bool drift = p.x() >= 40 && p.x() < 60 && p.y() > 4 && p.y() < 7;
  return (room && !pillar) || drift;
}

/// Distance from what the machine drives to all walls, looked at every centimetre.
double least_clearance(const std::vector<Segment>& walls, const std::vector<Pose2>& poses) {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 1; i < poses.size(); ++i) {
    const Vector2d from = poses[i - 1].translation();
    const Vector2d along = poses[i].translation() - from;
    const int pieces = 1 + static_cast<int>(along.norm() / 0.01);
    for (int k = 0; k <= pieces; ++k) {
      const Vector2d at = from + along * (static_cast<double>(k) / pieces);
      for (const Segment& wall : walls) least = std::min(least, distance(wall, at));
    }
  }
  return least;
}

double total_turn(const Drive& drive) {
  double sum = 0.0;
  for (std::size_t i = 1; i < drive.poses.size(); ++i) {
    sum += std::abs(angle_between(drive.poses[i - 1].theta, drive.poses[i].theta));
  }
  return sum;
}

TEST(DriveMap, TellsOpeningsFromPillarsAndRock) {
  const DriveMap map(pillar_and_drift());
  ASSERT_GT(map.size(), 700u);  // of 745 squares of the openings' 552 m² that are 0.8 m from walls
  for (std::size_t i = 0; i < map.size(); ++i) EXPECT_TRUE(is_in_openings(map.place(i)));
  EXPECT_GE(map.place_near({50.0, 5.5}), 0);
  EXPECT_EQ(map.place_near({20.0, 15.0}), -1);
  EXPECT_EQ(map.place_near({-3.0, -3.0}), -1);
}

TEST(DriveMap, TellsThemWhereWallsAreDrawnTwiceAndDangle) {
  std::vector<Segment> walls = pillar_and_drift();
  const std::vector<Segment> once = walls;
  for (std::size_t i = 0; i < once.size(); i += 2) {
    const Vector2d off(0.04, -0.03);
    walls.push_back({once[i].a + off, once[i].b + off});
  }
  walls.push_back({{10.0, 2.0}, {10.5, 2.6}});
  const DriveMap map(walls);
  ASSERT_GT(map.size(), 600u);
  for (std::size_t i = 0; i < map.size(); ++i) EXPECT_TRUE(is_in_openings(map.place(i)));
}

TEST(DriveMap, IsNotLedOutThroughAnEntry) {
  std::vector<Segment> walls = pillar_and_drift();
  walls.erase(walls.begin() + 3);  // the end of the drift
  const DriveMap map(walls);
  ASSERT_GT(map.size(), 600u);
  for (std::size_t i = 0; i < map.size(); ++i) EXPECT_TRUE(is_in_openings(map.place(i)));
}

TEST(DriveMap, TakesTheOpeningsOfPointsThatAreKnown) {
  const std::vector<Vector2d> inside = {{20.0, 15.0}};
  const DriveMap map(pillar_and_drift(), {}, inside);
  ASSERT_FALSE(map.empty());
  for (std::size_t i = 0; i < map.size(); ++i) EXPECT_FALSE(is_in_openings(map.place(i)));
}

TEST(DriveMap, IsEmptyWhereThereIsNoRoom) {
  EXPECT_TRUE(DriveMap().empty());
  EXPECT_TRUE(DriveMap(std::vector<Segment>{}).empty());
  EXPECT_TRUE(DriveMap(outline(std::vector<Vector2d>{{0, 0}, {1, 0}, {1, 1}, {0, 1}})).empty());
  EXPECT_TRUE(random_drive(DriveMap(), {}, 1).poses.empty());
}

TEST(WallBuckets, MeasureAsBruteForceDoes) {
  Random random(4);
  std::vector<Segment> walls;
  const auto point = [&] { return Vector2d(random.uniform(0, 30), random.uniform(-20, 10)); };
  for (int i = 0; i < 60; ++i) walls.push_back({point(), point()});
  for (int i = 0; i < 20; ++i) {  // level and upright ones, and points
    const Vector2d at = point();
    walls.push_back({at, at + Vector2d(i % 2 == 0 ? 3.0 : 0.0, i % 4 == 1 ? 3.0 : 0.0)});
  }
  const WallBuckets buckets(walls);
  for (int i = 0; i < test::repeats(500); ++i) {
    const Vector2d from = 1.5 * point();
    const Vector2d to = from + random.uniform(0.0, 1.0) * unit_vector(random.uniform(-kPi, kPi));
    double nearest = 2.0;
    for (int k = 0; k <= 1000; ++k) {
      const Vector2d at = from + (to - from) * (k / 1000.0);
      for (const Segment& wall : walls) nearest = std::min(nearest, distance(wall, at));
    }
    EXPECT_NEAR(buckets.clearance({from, to}, 2.0), nearest, 1e-3);
  }
}

TEST(RandomDrive, KeepsClearOfWallsOverItsWholeLength) {
  const std::vector<Segment> walls = pillar_and_drift();
  const DriveMap map(walls);
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    const Drive drive = random_drive(map, {.length_m = 90.0}, seed);
    EXPECT_NEAR(drive.length_m(), 90.0, 1e-9);
    EXPECT_GE(least_clearance(walls, drive.poses), map.options().clearance_m - 1e-9);
    for (std::size_t i = 1; i < drive.poses.size(); ++i) {
      const Vector2d step = drive.poses[i].translation() - drive.poses[i - 1].translation();
      EXPECT_LE(step.norm(), 0.45 + 1e-9);
      if (step.norm() < 1e-9) continue;
      // Ahead, or as far to a side as a corner needs that walls pin.
      EXPECT_GT(step.normalized().dot(unit_vector(drive.poses[i - 1].theta)), 0.5) << i;
    }
  }
}

TEST(RandomDrive, KeepsClearRoundTightCorners) {
  // A drift 2 m wide in steps of 4 m: rounded without regard to walls a corner would be cut.
  std::vector<Vector2d> left;
  std::vector<Vector2d> right;
  for (int i = 0; i < 12; ++i) {
    const Vector2d at(4.0 * ((i + 1) / 2), 4.0 * (i / 2));
    left.push_back(at + Vector2d(-1.0, 1.0));
    right.push_back(at + Vector2d(1.0, -1.0));
  }
  std::vector<Vector2d> around = left;
  around.insert(around.end(), right.rbegin(), right.rend());
  const std::vector<Segment> walls = outline(around);
  const DriveMap map(walls);
  ASSERT_GT(map.size(), 30u);
  for (std::uint64_t seed = 0; seed < 5; ++seed) {
    const Drive drive = random_drive(map, {.length_m = 60.0}, seed);
    EXPECT_NEAR(drive.length_m(), 60.0, 1e-9);
    EXPECT_GE(least_clearance(walls, drive.poses), 0.8 - 1e-9);
  }
}

TEST(RandomDrive, OfOneSeedIsOneDrive) {
  const DriveMap map(pillar_and_drift());
  const RandomDriveOptions options{.stops = 2, .turns = 1, .creeps = 2};
  const Drive a = random_drive(map, options, 5);
  const Drive b = random_drive(map, options, 5);
  const Drive c = random_drive(map, options, 6);
  ASSERT_EQ(a.poses.size(), b.poses.size());
  for (std::size_t i = 0; i < a.poses.size(); ++i) {
    EXPECT_EQ(a.poses[i].vector(), b.poses[i].vector());
    EXPECT_EQ(a.least_s[i], b.least_s[i]);
  }
  EXPECT_NE(a.poses.front().vector(), c.poses.front().vector());
}

TEST(RandomDrive, TurnsBackAtADeadEndOnTheSpot) {
  const DriveMap map(pillar_and_drift());
  const Pose2 start{57.0, 5.5, 0.0};
  const Drive drive = random_drive(map, {.length_m = 12.0}, 3, start);
  ASSERT_FALSE(drive.poses.empty());
  EXPECT_EQ(drive.poses.front().vector(), start.vector());
  EXPECT_LT(drive.poses.back().x, 50.0);
  EXPECT_NEAR(drive.length_m(), 12.0, 1e-9);
  EXPECT_TRUE(random_drive(map, {}, 3, Pose2{20.0, 15.0, 0.0}).poses.empty());
}

TEST(RandomDrive, StopsTurnsAndCreepsAreInIt) {
  const DriveMap map(pillar_and_drift());
  const Drive plain = random_drive(map, {.length_m = 60.0}, 2);
  RandomDriveOptions options{.length_m = 60.0, .stops = 3, .turns = 2};
  const Drive drive = random_drive(map, options, 2);
  EXPECT_EQ(drive.poses.size(), plain.poses.size() + 3 + 2 * 4);
  EXPECT_NEAR(drive.length_m(), 60.0, 1e-9);
  EXPECT_NEAR(total_turn(drive) - total_turn(plain), 2 * kTwoPi, 1e-9);
  const double stood = std::accumulate(drive.least_s.begin(), drive.least_s.end(), 0.0);
  EXPECT_GE(stood, 3 * 2.5);
  EXPECT_LE(stood, 3 * 7.5);
  // A fast turn rate: nothing but the stops and the turns takes longer.
  const double took = timed(drive, 1.0, 1e3).end() - timed(plain, 1.0, 1e3).end();
  EXPECT_NEAR(took, stood + 2 * kTwoPi / 1e3, 1e-9);

  options = {.length_m = 60.0, .creeps = 1, .creep_m_per_s = 0.05};
  const Drive creeping = random_drive(map, options, 2);
  const auto slow = std::find_if(creeping.least_s.begin(), creeping.least_s.end(),
                                 [](double seconds) { return seconds > 0.0; });
  ASSERT_NE(slow, creeping.least_s.end());
  const auto at = static_cast<std::size_t>(slow - creeping.least_s.begin());
  const double step_m =
      (creeping.poses[at].translation() - creeping.poses[at - 1].translation()).norm();
  EXPECT_NEAR(*slow, step_m / 0.05, 1e-9);
  EXPECT_NEAR(timed(creeping, 1.0, 1e3).end() - timed(plain, 1.0, 1e3).end(), *slow - step_m, 1e-6);
}

TEST(DriveBetween, PassesBothEndsInTheMiddle) {
  const std::vector<Segment> walls = pillar_and_drift();
  const DriveMap map(walls);
  const Drive drive = drive_between(map, {3.0, 15.0}, {55.0, 5.5});
  ASSERT_GT(drive.poses.size(), 100u);
  EXPECT_EQ(drive.poses.front().translation(), Vector2d(3.0, 15.0));
  EXPECT_EQ(drive.poses.back().translation(), Vector2d(55.0, 5.5));
  EXPECT_GE(least_clearance(walls, drive.poses), 0.8 - 1e-9);
  // Down and along, 12 + 52 m without a corner cut; up and round would be 100 m.
  EXPECT_GT(drive.length_m(), 55.0);
  EXPECT_LT(drive.length_m(), 66.0);
  for (const Pose2& pose : drive.poses) {
    if (pose.x > 10.0 && pose.x < 30.0) {
      EXPECT_NEAR(pose.y, 3.0, 0.5);
    }
    if (pose.x > 45.0) {
      EXPECT_NEAR(pose.y, 5.5, 0.3);
    }
  }
  EXPECT_TRUE(drive_between(map, {3.0, 15.0}, {20.0, 15.0}).poses.empty());
}

TEST(DriveBetween, IsEmptyWhereNoWayLeadsFromOneOpeningToAnother) {
  std::vector<Segment> rooms;
  for (const double x : {0.0, 20.0}) {
    const std::vector<Vector2d> corners{{x, 0.0}, {x + 8.0, 0.0}, {x + 8.0, 8.0}, {x, 8.0}};
    const std::vector<Segment> room = outline(corners);
    rooms.insert(rooms.end(), room.begin(), room.end());
  }
  const DriveMap map(rooms);
  EXPECT_FALSE(drive_between(map, {2.0, 2.0}, {6.0, 6.0}).poses.empty());
  EXPECT_FALSE(drive_between(map, {22.0, 2.0}, {26.0, 6.0}).poses.empty());
  EXPECT_TRUE(drive_between(map, {4.0, 4.0}, {24.0, 4.0}).poses.empty());
}

TEST(RandomDrive, GoesThroughAPanelWithoutItsPath) {
  const double length_m = 150.0 / test::kFewer;
  const World world = panel({}, 3);
  const DriveMap map(world.walls);
  const Drive drive = random_drive(map, {.length_m = length_m}, 3);
  EXPECT_NEAR(drive.length_m(), length_m, 1e-9);
  EXPECT_GE(least_clearance(world.walls, drive.poses), 0.8 - 1e-9);
}

}  // namespace
}  // namespace adit
