#include "adit/recovery/drive_memory.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "support/recovery_scene.hpp"

namespace adit {
namespace {

/// A room with a niche in its upper wall, and forty metres east one without.
std::vector<Segment> rooms() {
  const auto line = [](std::vector<Vector2d> corners) {
    std::vector<Segment> walls;
    for (std::size_t i = 0; i < corners.size(); ++i)
      walls.push_back({corners[i], corners[(i + 1) % corners.size()]});
    return walls;
  };
  std::vector<Segment> plan =
      line({{0, 0}, {20, 0}, {20, 12}, {16, 12}, {16, 15}, {10, 15}, {10, 12}, {0, 12}});
  for (const Segment& wall : line({{40, 0}, {60, 0}, {60, 12}, {40, 12}})) plan.push_back(wall);
  return plan;
}

class DriveMemoryTest : public RecoveryScene {
 protected:
  DriveMemoryTest() : RecoveryScene(rooms()) {}

  /// Drives from the pose and keeps what is seen; afterwards `at` is where the vehicle stands.
  void drive(DriveMemory& memory, const Pose2& from, int steps, double step_m) {
    at = from;
    for (int i = 0; i < steps; ++i) {
      const LaserScan scan = scan_from(at);
      memory.add({map, scan, scanner, error, std::nullopt}, options);
      memory.predict({step_m, 0.0, 0.0}, OdometryNoise{}, tracking);
      at = at * Pose2{step_m, 0.0, 0.0};
    }
  }

  Retrospect look_back(const DriveMemory& memory, const Pose2& pose, int scans_to_refute = 100) {
    return memory.look_back(near(pose), {map, refinement, tracking, status}, 0.75, refiner,
                            scans_to_refute);
  }

  DriveMemoryOptions options;
  Refiner refiner;
  Pose2 at;
};

TEST_F(DriveMemoryTest, KeepsAScanAfterSomeWayAndTheNewestOnly) {
  options.spacing_m = 1.0;
  options.most_scans = 3;
  DriveMemory memory;
  drive(memory, {2.0, 6.0, 0.0}, 4, 0.5);
  EXPECT_EQ(memory.size(), 2u);
  drive(memory, at, 8, 0.5);
  EXPECT_EQ(memory.size(), 3u);
  memory.clear();
  EXPECT_EQ(memory.size(), 0u);
}

TEST_F(DriveMemoryTest, TheTruePoseExplainsAllOfTheWay) {
  options.spacing_m = 1.0;
  DriveMemory memory;
  drive(memory, {4.0, 6.0, 0.2}, 5, 1.0);
  const Retrospect past = look_back(memory, at);
  ASSERT_EQ(past.witnesses.size(), 5u);
  EXPECT_EQ(past.explained, 5);
  EXPECT_NEAR(past.explained_m, 5.0, 1e-9);
  EXPECT_EQ(past.contradicted, 0);
  for (const Witness& witness : past.witnesses) EXPECT_TRUE(witness.sees);
}

TEST_F(DriveMemoryTest, AnotherPlaceIsRefutedAndNoMoreIsFittedThen) {
  options.spacing_m = 1.0;
  DriveMemory memory;
  drive(memory, {4.0, 6.0, 0.2}, 6, 1.0);
  const Pose2 other{at.x, at.y, wrap_angle(at.theta + kPi)};  // looks the other way
  const Retrospect past = look_back(memory, other);
  EXPECT_EQ(past.witnesses.size(), 6u);
  EXPECT_EQ(past.explained, 0);
  EXPECT_GE(past.contradicted, 2);
  EXPECT_LT(look_back(memory, other, 2).witnesses.size(), 6u);
  EXPECT_GE(look_back(memory, other, 2).contradicted, 2);
}

TEST_F(DriveMemoryTest, ARoomThatIsMuchAlikeExplainsLess) {
  options.spacing_m = 1.0;
  DriveMemory memory;
  drive(memory, {4.0, 6.0, 0.2}, 5, 1.0);
  const Retrospect here = look_back(memory, at);
  const Retrospect there = look_back(memory, {at.x + 40.0, at.y, at.theta});
  ASSERT_EQ(here.witnesses.size(), there.witnesses.size());
  for (std::size_t i = 0; i < here.witnesses.size(); ++i) {
    EXPECT_GT(here.witnesses[i].log_likelihood, there.witnesses[i].log_likelihood + 10.0) << i;
  }
}

TEST_F(DriveMemoryTest, ABlindScanSaysNothing) {
  options.spacing_m = 1.0;
  DriveMemory memory;
  const double range_m = scanner.max_range_m;
  drive(memory, {4.0, 6.0, 0.2}, 2, 1.0);
  scanner.max_range_m = 0.5;
  drive(memory, at, 1, 1.0);
  scanner.max_range_m = range_m;
  drive(memory, at, 2, 1.0);
  const Retrospect past = look_back(memory, at);
  ASSERT_EQ(past.witnesses.size(), 5u);
  EXPECT_FALSE(past.witnesses[2].sees);
  EXPECT_EQ(past.explained, 4);
  EXPECT_EQ(past.contradicted, 0);
}

}  // namespace
}  // namespace adit
