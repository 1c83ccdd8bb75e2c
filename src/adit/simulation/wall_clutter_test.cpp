#include "adit/simulation/wall_clutter.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "adit/simulation/mine_worlds.hpp"
#include "adit/simulation/ray_caster.hpp"
#include "adit/simulation/way.hpp"

namespace adit {
namespace {

/// Share of the beams all round, from all poses of the way, that clutter hides a wall from.
double hidden_share(const World& world) {
  constexpr int kBeams = 180;
  const RayCaster walls(world.walls);
  const RayCaster clutter(world.clutter);
  int hidden = 0;
  for (const Pose2& pose : world.path) {
    for (int i = 0; i < kBeams; ++i) {
      const Vector2d direction = unit_vector(kTwoPi * i / kBeams);
      const double wall = walls.range(pose.translation(), direction);
      hidden += clutter.range(pose.translation(), direction) < wall ? 1 : 0;
    }
  }
  return hidden / (kBeams * static_cast<double>(world.path.size()));
}

/// In the mean over seeds.
double hidden_share(const char* kind, int pieces) {
  double sum = 0.0;
  constexpr int kSeeds = 10;
  for (std::uint64_t seed = 0; seed < kSeeds; ++seed) {
    World world = mockup();
    EXPECT_EQ(add_wall_clutter(world, *wall_clutter_named(kind, pieces), seed), pieces);
    sum += hidden_share(world) / kSeeds;
  }
  return sum;
}

/// A straight opening, 6 m wide, with a way along its middle.
World entry() {
  World world = from_plan(outline(std::vector<Vector2d>{{0, 0}, {60, 0}, {60, 6}, {0, 6}}));
  for (double x = 5.0; x < 55.0; x += 0.5) world.path.push_back({x, 3.0, 0.0});
  return world;
}

bool crosses(const Segment& s, const Segment& t) { return distance_between(s, t) == 0.0; }

TEST(WallClutter, HidesAThirdToAHalfOfTheView) {
  const double mixed = hidden_share("mixed", 20);
  EXPECT_GT(mixed, 0.33);
  EXPECT_LT(mixed, 0.5);
  const double rows = hidden_share("rows", 2);
  EXPECT_GT(rows, 0.33);
  EXPECT_LT(rows, 0.5);
}

TEST(WallClutter, KeepsTheWayClear) {
  for (const char* kind : {"against", "piercing", "along", "rows", "mixed", "groups"}) {
    World world = drift({}, 3);
    const WallClutterOptions options = *wall_clutter_named(kind, 8);
    EXPECT_GT(add_wall_clutter(world, options, 4), 4) << kind;
    for (const Segment& side : world.clutter) {
      for (const Segment& link : way_of(world.path)) {
        ASSERT_GE(distance_between(side, link), options.path_clearance_m) << kind;
      }
    }
  }
}

TEST(WallClutter, StandsAtTheWallAsItsKindSays) {
  World against = entry();
  ASSERT_EQ(add_wall_clutter(against, *wall_clutter_named("against", 12), 1), 12);
  for (std::size_t box = 0; box < against.clutter.size(); box += 4) {
    double nearest = 1e9;
    for (std::size_t k = box; k < box + 4; ++k) {
      EXPECT_LE(against.clutter[k].length(), 1.5);
      for (const Segment& wall : against.walls) {
        nearest = std::min(nearest, distance_between(against.clutter[k], wall));
      }
    }
    EXPECT_LE(nearest, 0.06);
  }
  World along = entry();
  ASSERT_EQ(add_wall_clutter(along, *wall_clutter_named("along", 4), 1), 4);
  for (std::size_t box = 0; box < along.clutter.size(); box += 4) {
    EXPECT_GE(std::max(along.clutter[box].length(), along.clutter[box + 1].length()), 4.0);
  }
}

TEST(WallClutter, IsPiercedByTheWall) {
  World world = entry();
  ASSERT_EQ(add_wall_clutter(world, *wall_clutter_named("piercing", 12), 1), 12);
  for (std::size_t box = 0; box < world.clutter.size(); box += 4) {
    int crossings = 0;
    for (std::size_t k = box; k < box + 4; ++k) {
      for (const Segment& wall : world.walls) crossings += crosses(world.clutter[k], wall) ? 1 : 0;
    }
    EXPECT_GE(crossings, 2);
  }
}

TEST(WallClutter, LinesBothSidesOfTheEntry) {
  World world = entry();
  ASSERT_EQ(add_wall_clutter(world, *wall_clutter_named("rows", 1), 3), 1);
  const auto low = std::count_if(world.clutter.begin(), world.clutter.end(),
                                 [](const Segment& s) { return s.a.y() < 2.0; });
  const auto high = std::count_if(world.clutter.begin(), world.clutter.end(),
                                  [](const Segment& s) { return s.a.y() > 4.0; });
  EXPECT_GE(low, 4 * 5);
  EXPECT_GE(high, 4 * 5);
}

TEST(WallClutter, GroupsWalkAlongTheWay) {
  World world = entry();
  ASSERT_EQ(add_wall_clutter(world, *wall_clutter_named("groups", 2), 3), 2);
  ASSERT_EQ(world.people.size(), 6u);
  for (const Person& person : world.people) {
    EXPECT_GE(std::abs(person.to.x() - person.from.x()), 6.0);
    EXPECT_NEAR(person.to.y(), person.from.y(), 1e-9);
  }
  for (double t = 0.0; t < 20.0; t += 0.5) {
    for (const Segment& side : people_at(world, t)) {
      EXPECT_GE(side.a.y(), 0.0);
      EXPECT_LE(side.a.y(), 6.0);
      EXPECT_GE(std::abs(side.a.y() - 3.0), 1.2);
    }
  }
}

TEST(WallClutter, FollowsItsSeedAndKnowsItsKinds) {
  const auto first_corner = [](std::uint64_t seed) {
    World world = entry();
    add_wall_clutter(world, *wall_clutter_named("mixed", 8), seed);
    return world.clutter.front().a;
  };
  EXPECT_EQ(first_corner(1), first_corner(1));
  EXPECT_NE(first_corner(1), first_corner(2));
  EXPECT_FALSE(wall_clutter_named("nonsense", 1).has_value());
  World without_path = from_plan(mockup().plan);
  EXPECT_EQ(add_wall_clutter(without_path, *wall_clutter_named("against", 8), 1), 0);
}

}  // namespace
}  // namespace adit
