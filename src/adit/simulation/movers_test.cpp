#include <gtest/gtest.h>

#include <cmath>

#include "adit/simulation/machine_ahead.hpp"
#include "adit/simulation/ramps_on_way.hpp"
#include "adit/simulation/ray_caster.hpp"
#include "adit/simulation/vehicle.hpp"

namespace adit {
namespace {

Vector2d middle_of(const std::vector<Segment>& sides) {
  Vector2d sum = Vector2d::Zero();
  for (const Segment& side : sides) sum += side.a / static_cast<double>(sides.size());
  return sum;
}

TEST(MachineAhead, KeepsItsGapAndTurnsOffAtTheEnd) {
  World world;
  const std::vector<Pose2> poses{{0, 0, 0}, {20, 0, 0}, {20, 0, 0.5 * kPi}, {20, 30, 0.5 * kPi}};
  const TimedPath drive = drive_along(poses, 2.0, 0.5);
  MachineAheadOptions options;
  options.gap_m = 5.0;
  const double there = add_machine_ahead(world, drive, options);
  // 45 of the 50 m at 2 m/s, and the turn on the spot, in which it waits.
  EXPECT_NEAR(there, 22.5 + kPi, 0.3);
  const std::vector<Segment> body = movers_at(world, 3.0);
  ASSERT_EQ(body.size(), 4u);
  EXPECT_LT((middle_of(body) - Vector2d(11.0, 0.0)).norm(), 1e-6);
  EXPECT_NEAR(body[0].length() + body[1].length(), 2.5 + 1.8, 1e-12);
  EXPECT_LT((middle_of(movers_at(world, 9.0)) - Vector2d(20.0, 3.0)).norm(), 1e-6);
  EXPECT_TRUE(movers_at(world, drive.end()).empty());
}

TEST(MachineAhead, IsGoneWhereTheWayLeadsBackToTheVehicle) {
  World world;
  const std::vector<Pose2> poses{{0, 0, 0}, {20, 0, 0}, {20, 0, kPi}, {0, 0, kPi}};
  const TimedPath drive = drive_along(poses, 1.0, 0.5);
  add_machine_ahead(world, drive, {});
  EXPECT_EQ(world.movers.size(), 2u);
  for (double t = 0.0; t < drive.end(); t += 0.05) {
    const std::vector<Segment> body = movers_at(world, t);
    if (body.empty()) continue;
    EXPECT_GE((middle_of(body) - drive.at(t).translation()).norm(), 0.6 * 6.0 - 0.11);
  }
}

TEST(MachineAhead, StandsInTheScans) {
  World world = from_plan(outline(std::vector<Vector2d>{{0, 0}, {60, 0}, {60, 6}, {0, 6}}));
  world.path = {{5, 3, 0}, {40, 3, 0}};
  const DriveOptions options;
  add_machine_ahead(world, drive_along(world.path, 1.0, 0.5), {});
  ScannerSpec spec = sick();
  spec.beams = 1;
  spec.first_bearing = 0.0;
  const Recording run = record_drive(world, world.path, spec, options, 1);
  EXPECT_NEAR(run.scans[10].ranges[0], 6.0 - 1.25, 0.1);
  EXPECT_NEAR(run.scans.back().ranges[0], 20.0, 0.2) << "the end wall, once it has turned off";
}

/// Ahead along the rise, or back down it.
double seen(const Ramp& ramp, double at, double direction) {
  return cast_ray(cuts_of(ramp, {at, 0.3}), {at, 0.3}, {direction, 0.0});
}

TEST(Ramp, EndsBeamsWhereFloorOrRoofCutTheScannersPlane) {
  Ramp ramp;  // rises along x from 0 to 20 m
  ramp.slope_rad = std::atan(0.1);
  constexpr double kNever = std::numeric_limits<double>::infinity();
  // Before it: the floor rises to the scanner's 1 m within 10 m.
  EXPECT_NEAR(seen(ramp, -7.0, 1.0), 17.0, 1e-9);
  EXPECT_EQ(seen(ramp, -7.0, -1.0), kNever);
  // On it: the plane dives into the level floor 10 m before the foot, and climbs into the roof,
  // 1.2 m above the scanner, 12 m after the top.
  EXPECT_NEAR(seen(ramp, 5.0, -1.0), 15.0, 1e-9);
  EXPECT_NEAR(seen(ramp, 5.0, 1.0), 27.0, 1e-9);
  // After it: the roof falls away ahead, below the plane 12 m down.
  EXPECT_NEAR(seen(ramp, 26.0, -1.0), 18.0, 1e-9);
  // Too short a ramp reaches neither, and a place beside it has its own floor.
  ramp.length_m = 8.0;
  EXPECT_EQ(seen(ramp, -7.0, 1.0), kNever);
  EXPECT_TRUE(cuts_of(ramp, {5.0, 4.0}).empty());
}

TEST(Ramp, TurnsWithItsHeading) {
  Ramp ramp;
  ramp.foot = {3, 4};
  ramp.heading = 0.5 * kPi;
  ramp.slope_rad = std::atan(0.1);
  const std::vector<Segment> cuts = cuts_of(ramp, {3, 0});
  ASSERT_EQ(cuts.size(), 1u);
  EXPECT_NEAR(cuts[0].a.y(), 14.0, 1e-9);
  EXPECT_NEAR(cuts[0].b.y(), 14.0, 1e-9);
  EXPECT_NEAR(cuts[0].length(), 6.0, 1e-9);
}

TEST(Ramp, IsLaidOnTheWayAndShortensBeams) {
  World world = from_plan(outline(std::vector<Vector2d>{{0, 0}, {90, 0}, {90, 6}, {0, 6}}));
  for (double x = 5.0; x < 85.0; x += 1.0) world.path.push_back({x, 3.0, 0.0});
  ASSERT_EQ(lay_ramps(world, 1, 2), 1);
  EXPECT_NEAR(world.ramps[0].width_m, 6.0, 1e-9);
  EXPECT_NEAR(world.ramps[0].foot.y(), 3.0, 1e-9);
  int shortened = 0;
  for (const Pose2& pose : world.path) {
    const std::vector<Segment> cuts = passing_segments(world, {0.0, pose});
    shortened += cast_ray(cuts, pose.translation(), {1.0, 0.0}) < 90.0 - pose.x ? 1 : 0;
  }
  EXPECT_GT(shortened, 5);
}

}  // namespace
}  // namespace adit
