#include "adit/simulation/world.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "adit/simulation/clutter.hpp"
#include "adit/simulation/mine_worlds.hpp"
#include "adit/simulation/paper_run.hpp"
#include "adit/simulation/ray_caster.hpp"
#include "support/repeats.hpp"

namespace adit {
namespace {

double clearance(const std::vector<Segment>& walls, const Vector2d& point) {
  double nearest = 1e9;
  for (const Segment& wall : walls) nearest = std::min(nearest, distance(wall, point));
  return nearest;
}

bool crosses(const Segment& s, const Segment& t) {
  const auto side = [](const Segment& of, const Vector2d& p) {
    return cross(of.b - of.a, p - of.a) > 0.0;
  };
  return side(s, t.a) != side(s, t.b) && side(t, s.a) != side(t, s.b);
}

int count_crossings(const std::vector<Segment>& walls) {
  int count = 0;
  for (std::size_t i = 0; i < walls.size(); ++i) {
    for (std::size_t j = i + 1; j < walls.size(); ++j) {
      const bool joined = walls[i].b == walls[j].a || walls[j].b == walls[i].a;
      if (!joined && crosses(walls[i], walls[j])) ++count;
    }
  }
  return count;
}

/// Every end is shared by exactly two walls: closed outlines, joined properly.
void expect_closed(const std::vector<Segment>& walls) {
  std::map<std::pair<double, double>, int> ends;
  for (const Segment& wall : walls) {
    ++ends[{wall.a.x(), wall.a.y()}];
    ++ends[{wall.b.x(), wall.b.y()}];
  }
  for (const auto& [end, count] : ends) {
    EXPECT_EQ(count, 2) << "at " << end.first << ", " << end.second;
  }
}

/// RMS distance of the true walls from the plan, away from the plan's corners.
double roughness(const World& world) {
  double squares = 0.0;
  int count = 0;
  for (const Segment& wall : world.walls) {
    const bool at_corner = std::any_of(world.plan.begin(), world.plan.end(), [&](const Segment& s) {
      return (s.a - wall.a).norm() < 2.0 || (s.b - wall.a).norm() < 2.0;
    });
    if (at_corner) continue;
    const double off = clearance(world.plan, wall.a);
    squares += off * off;
    ++count;
  }
  return std::sqrt(squares / count);
}

TEST(PlanError, IsTheDistanceOfTheWallsAndNotOfTheirCounts) {
  const std::vector<Segment> room = outline(std::vector<Vector2d>{{0, 0}, {8, 0}, {8, 5}, {0, 5}});
  World world = from_plan(room);
  EXPECT_EQ(plan_error(world), 0.0);
  EXPECT_EQ(plan_error({}), 0.0);
  // as many walls, two of the four 0.2 m further out
  world.walls = outline(std::vector<Vector2d>{{-0.2, 0}, {8.2, 0}, {8.2, 5}, {-0.2, 5}});
  EXPECT_NEAR(plan_error(world), std::sqrt(2 * 0.2 * 0.2 / 4), 1e-12);
  // more walls, all of them on the plan
  world.walls = room;
  world.walls.front().b = {4, 0};
  world.walls.push_back({{4, 0}, {8, 0}});
  EXPECT_NEAR(plan_error(world), 0.0, 1e-12);
  EXPECT_NEAR(plan_error(panel({}, 3)), roughness(panel({}, 3)), 0.1);
}

TEST(Mockup, HasTheTwentyNineSegmentsOfThePaper) {
  const World world = mockup();
  EXPECT_EQ(world.plan.size(), 29u);
  EXPECT_EQ(world.walls.size(), 29u);
  expect_closed(world.plan);
  EXPECT_EQ(count_crossings(world.plan), 0);
}

TEST(Mockup, CoversAboutTwentyByThirtyMetres) {
  Vector2d low(1e9, 1e9);
  Vector2d high(-1e9, -1e9);
  for (const Segment& s : mockup().walls) {
    low = low.cwiseMin(s.a);
    high = high.cwiseMax(s.a);
  }
  EXPECT_NEAR(high.x() - low.x(), 20.0, 1.0);
  EXPECT_NEAR(high.y() - low.y(), 30.0, 1.0);
}

TEST(Mockup, HasColumnsOfFortyCentimetresAndCorridorsOfSixMetres) {
  const World world = mockup();
  const auto forty = std::count_if(world.walls.begin(), world.walls.end(), [](const Segment& s) {
    return std::abs(s.length() - 0.4) < 1e-9;
  });
  EXPECT_EQ(forty, 12) << "four columns of three sides";
  const Vector2d west(-1.0, 0.0);
  const Vector2d in_corridor(3.5, 8.0);
  EXPECT_NEAR(cast_ray(world.walls, in_corridor, west) + cast_ray(world.walls, in_corridor, -west),
              6.0, 1e-9);
  const Vector2d across = unit_vector(std::atan(0.3686) + radians(90.0));
  const Vector2d in_slant(9.179, 16.517);
  EXPECT_NEAR(cast_ray(world.walls, in_slant, across) + cast_ray(world.walls, in_slant, -across),
              6.0, 1e-3);
}

TEST(Mockup, PathKeepsToTheMiddleOfTheCorridors) {
  const World world = mockup();
  ASSERT_EQ(world.path.size(), 16u);
  for (std::size_t i = 0; i < world.path.size(); ++i) {
    EXPECT_GE(clearance(world.walls, world.path[i].translation()), 2.0) << "pose " << i;
    EXPECT_EQ(world.path[i].x, kPaperRun[i].surveyed_x);
    EXPECT_NEAR(angle_between(radians(kPaperRun[i].estimated_deg), world.path[i].theta), 0.0,
                radians(1.9 + 1e-3))
        << "the paper's largest heading error is 1.9 degrees";
  }
}

TEST(Mockup, EveryBeamFromThePathMeetsAWall) {
  const World world = mockup();
  for (const Pose2& pose : world.path) {
    for (int i = 0; i < 3600; ++i) {
      ASSERT_LE(cast_ray(world.walls, pose.translation(), unit_vector(kTwoPi * i / 3600)), 50.0);
    }
  }
}

TEST(PaperRun, HasTheErrorsThatThePaperStates) {
  double sum = 0.0;
  double largest = 0.0;
  for (const PaperRow& row : kPaperRun) {
    const double error =
        std::hypot(row.estimated_x - row.surveyed_x, row.estimated_y - row.surveyed_y);
    sum += error;
    largest = std::max(largest, error);
  }
  EXPECT_NEAR(sum / 16.0, 0.19, 0.005);
  EXPECT_NEAR(largest, 0.40, 0.005);
  double heading = 0.0;
  for (const PaperRow& row : kPaperRun) {
    heading += std::abs(row.estimated_deg - row.gyro_deg.value_or(row.estimated_deg));
  }
  EXPECT_NEAR(heading / 15.0, 0.67, 0.05);
}

TEST(Panel, HasRoughWallsRoundAStraightPlan) {
  const PanelOptions options;
  const World world = panel(options, 5);
  EXPECT_EQ(world.plan.size(), 4u * (1 + 12));
  expect_closed(world.walls);
  EXPECT_EQ(count_crossings(world.walls), 0);
  EXPECT_NEAR(roughness(world), options.walls.rms_m, 0.015);
  for (const Pose2& pose : world.path) {
    ASSERT_GE(clearance(world.walls, pose.translation()), 1.5);
  }
}

TEST(Panel, RoundsItsCorners) {
  PanelOptions options;
  options.walls.rms_m = 0.0;
  const World world = panel(options, 1);
  // A quarter circle of radius r leaves the corner by (sqrt 2 - 1) r.
  const double expected = (std::sqrt(2.0) - 1.0) * options.walls.corner_radius_m;
  for (const Segment& rib : world.plan) EXPECT_NEAR(clearance(world.walls, rib.a), expected, 0.03);
}

TEST(Panel, ShiftsEverySecondRow) {
  PanelOptions options;
  options.offset_m = 7.0;
  options.variation_m = 0.0;
  const World world = panel(options, 1);
  EXPECT_NEAR(world.plan[4].a.x(), options.entry_width_m, 1e-9);
  EXPECT_NEAR(world.plan[std::size_t{20}].a.x(), options.entry_width_m + 7.0, 1e-9);
}

TEST(Roughness, IsCorrelatedOverTheLengthAskedFor) {
  RoughnessOptions options;
  options.corner_radius_m = 0.0;
  Random random(11);
  const Polyline square{{{0.0, 0.0}, {1000.0, 0.0}, {1000.0, 1000.0}, {0.0, 1000.0}}, true};
  const Polyline rough = roughen(square, options, random);
  const auto lag =
      static_cast<std::size_t>(std::lround(options.correlation_m / options.point_spacing_m));
  double products = 0.0;
  double squares = 0.0;
  for (std::size_t i = 10; i < 3900; ++i) {  // the lower side, where y is the roughness
    products += rough.points[i].y() * rough.points[i + lag].y();
    squares += rough.points[i].y() * rough.points[i].y();
  }
  EXPECT_NEAR(std::sqrt(squares / 3890.0), options.rms_m, 0.01);
  EXPECT_NEAR(products / squares, std::exp(-1.0), 0.08);
}

TEST(Drift, IsOneOpeningWithRoomForTheDrive) {
  for (std::uint64_t seed = 0; seed < test::repeats(20); ++seed) {
    const World world = drift({}, seed);
    expect_closed(world.plan);
    EXPECT_EQ(count_crossings(world.plan), 0) << "seed " << seed;
    EXPECT_EQ(count_crossings(world.walls), 0) << "seed " << seed;
    for (const Pose2& pose : world.path) {
      ASSERT_GE(clearance(world.walls, pose.translation()), 1.2) << "seed " << seed;
    }
  }
}

TEST(Drift, HasWavesAndRibs) {
  const DriftOptions options;
  const RoughnessOptions& walls = options.walls;
  double squares = 0.0;
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    const double rms = roughness(drift(options, seed));
    squares += rms * rms / 10.0;
  }
  const double saw_tooth = walls.rib_depth_m / std::sqrt(12.0);
  const double expected = std::sqrt(walls.rms_m * walls.rms_m + saw_tooth * saw_tooth +
                                    walls.wave_rms_m * walls.wave_rms_m);
  EXPECT_NEAR(std::sqrt(squares), expected, 0.03);
}

TEST(Worlds, FollowTheirSeeds) {
  EXPECT_EQ(panel({}, 4).walls[100].a, panel({}, 4).walls[100].a);
  EXPECT_NE(panel({}, 4).walls[100].a, panel({}, 5).walls[100].a);
  EXPECT_EQ(drift({}, 4).walls[100].a, drift({}, 4).walls[100].a);
}

TEST(Clutter, KeepsClearOfWayWallsAndItself) {
  for (std::uint64_t seed = 0; seed < test::repeats(50); ++seed) {
    World world = mockup();
    ASSERT_EQ(add_clutter(world, clutter_of(8), seed), 8) << "seed " << seed;
    ASSERT_EQ(world.clutter.size(), 5u * 4u + 3u * 8u);
    EXPECT_EQ(world.plan.size(), 29u);
    for (const Segment& side : world.clutter) {
      EXPECT_LE(side.length(), 1.5);
      for (const Pose2& pose : world.path) EXPECT_GE(distance(side, pose.translation()), 1.2);
      for (const Segment& wall : world.walls) EXPECT_FALSE(crosses(side, wall));
    }
    EXPECT_EQ(count_crossings(world.clutter), 0);
  }
}

TEST(Clutter, StandsInSightOfTheWay) {
  World world = drift({}, 3);
  add_clutter(world, clutter_of(16), 3);
  for (const Segment& side : world.clutter) {
    const bool seen = std::any_of(world.path.begin(), world.path.end(), [&](const Pose2& pose) {
      const Vector2d to = 0.5 * (side.a + side.b) - pose.translation();
      return cast_ray(world.walls, pose.translation(), to.normalized()) > to.norm();
    });
    EXPECT_TRUE(seen);
  }
}

TEST(Clutter, PlacesWhatThereIsRoomFor) {
  World world = mockup();
  EXPECT_LT(add_clutter(world, clutter_of(500), 1), 500);
  World without_path = from_plan(mockup().plan);
  EXPECT_EQ(add_clutter(without_path, clutter_of(8), 1), 0);
}

TEST(People, PaceBetweenTheirTwoPoints) {
  World world;
  world.people.push_back({{0.0, 0.0}, {4.0, 0.0}, 1.0, 0.5});
  const auto center = [&](double stamp) {
    Vector2d sum = Vector2d::Zero();
    for (const Segment& side : people_at(world, stamp)) sum += side.a / 8.0;
    return sum;
  };
  EXPECT_NEAR(center(1.0).x(), 1.0, 1e-12);
  EXPECT_NEAR(center(4.0).x(), 4.0, 1e-12);
  EXPECT_NEAR(center(5.0).x(), 3.0, 1e-12);
  EXPECT_NEAR(center(9.0).x(), 1.0, 1e-12);
  ClutterOptions walkers;
  walkers.walkers = 4;
  World hall = mockup();
  EXPECT_EQ(add_clutter(hall, walkers, 1), 12);
  for (double t = 0.0; t < 30.0; t += 0.5) {
    for (const Segment& side : people_at(hall, t)) {
      for (const Segment& wall : hall.walls) ASSERT_FALSE(crosses(side, wall));
      for (const Pose2& pose : hall.path) ASSERT_GE(distance(side, pose.translation()), 1.15);
    }
  }
}

}  // namespace
}  // namespace adit
