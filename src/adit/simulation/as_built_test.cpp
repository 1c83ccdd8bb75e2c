#include "adit/simulation/as_built.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "adit/simulation/smooth_field.hpp"
#include "adit/simulation/wall_chains.hpp"
#include "adit/simulation/way.hpp"
#include "support/repeats.hpp"

namespace adit {
namespace {

/// Pillars of 14 m in entries of 6 m, and a way along an entry.
World pillars(int rows, int columns) {
  constexpr double kPitch = 20.0;
  std::vector<Segment> plan =
      outline(std::vector<Vector2d>{{0, 0},
                                    {columns * kPitch + 6, 0},
                                    {columns * kPitch + 6, rows * kPitch + 6},
                                    {0, rows * kPitch + 6}});
  for (int r = 0; r < rows; ++r) {
    for (int c = 0; c < columns; ++c) {
      const double x = 6 + c * kPitch;
      const double y = 6 + r * kPitch;
      const std::vector<Segment> pillar =
          outline(std::vector<Vector2d>{{x, y}, {x, y + 14}, {x + 14, y + 14}, {x + 14, y}});
      plan.insert(plan.end(), pillar.begin(), pillar.end());
    }
  }
  World world = from_plan(std::move(plan));
  for (double x = 3.0; x < columns * kPitch; x += 1.0) world.path.push_back({x, 23.0, 0.0});
  return world;
}

double length(const std::vector<Segment>& walls) {
  double sum = 0.0;
  for (const Segment& wall : walls) sum += wall.length();
  return sum;
}

bool same(const std::vector<Segment>& s, const std::vector<Segment>& t) {
  return std::equal(s.begin(), s.end(), t.begin(), t.end(),
                    [](const Segment& a, const Segment& b) { return a.a == b.a && a.b == b.b; });
}

double clearance(const World& world) {
  double nearest = 1e9;
  for (const Segment& link : way_of(world.path)) {
    for (const Segment& wall : world.walls) {
      nearest = std::min(nearest, distance_between(wall, link));
    }
  }
  return nearest;
}

/// Ends of walls that no other wall has or touches.
int count_loose_ends(const std::vector<Segment>& walls) {
  int loose = 0;
  for (std::size_t i = 0; i < walls.size(); ++i) {
    for (const Vector2d& end : {walls[i].a, walls[i].b}) {
      bool meets = false;
      for (std::size_t j = 0; j < walls.size(); ++j) {
        meets = meets || (i != j && distance(walls[j], end) < 2e-3);
      }
      loose += meets ? 0 : 1;
    }
  }
  return loose;
}

/// Moments of a field over many points and many seeds, and products of points `lag` apart.
struct Moments {
  Vector2d mean = Vector2d::Zero();
  Vector2d variance = Vector2d::Zero();
  Vector2d lagged = Vector2d::Zero();
  double between_axes = 0.0;
};

Moments moments_of(double sigma, double reach, const Vector2d& lag) {
  Moments m;
  constexpr int kSeeds = 40;
  constexpr int kPoints = 400;
  for (int seed = 0; seed < kSeeds; ++seed) {
    Random random(static_cast<std::uint64_t>(seed), 77);
    const SmoothField field(sigma, reach, random);
    for (int i = 0; i < kPoints; ++i) {
      const Vector2d p{random.uniform(-500.0, 500.0), random.uniform(-500.0, 500.0)};
      const Vector2d here = field.at(p);
      m.mean += here / (kSeeds * kPoints);
      m.variance += here.cwiseAbs2() / (kSeeds * kPoints);
      m.lagged += here.cwiseProduct(field.at(p + lag)) / (kSeeds * kPoints);
      m.between_axes += here.x() * here.y() / (kSeeds * kPoints);
    }
  }
  return m;
}

TEST(SmoothField, HasTheSigmaAndTheCovarianceThatItStates) {
  for (const Vector2d& lag : {Vector2d(8.0, 0.0), Vector2d(0.0, 8.0), Vector2d(3.0, -4.0)}) {
    const Moments m = moments_of(0.15, 8.0, lag);
    const double variance = 0.15 * 0.15;
    const double expected = std::exp(-lag.squaredNorm() / 64.0);
    for (int axis = 0; axis < 2; ++axis) {
      EXPECT_NEAR(m.mean[axis], 0.0, 0.005);
      EXPECT_NEAR(m.variance[axis] / variance, 1.0, 0.05);
      EXPECT_NEAR(m.lagged[axis] / variance, expected, 0.05);
    }
    EXPECT_NEAR(m.between_axes / variance, 0.0, 0.03);
  }
}

TEST(WallChains, RunFromCornerToCorner) {
  // A bend of 20 degrees goes on, the corner of 90 does not, nor does a junction of three.
  const Vector2d bend(10.0, 0.0);
  const Vector2d corner = bend + 10.0 * unit_vector(radians(20.0));
  const Vector2d end = corner + 10.0 * unit_vector(radians(110.0));
  const std::vector<Segment> walls{{bend, Vector2d(0, 0)},
                                   {bend, corner},
                                   {end, corner},
                                   {end, end + Vector2d(3, 0)},
                                   {end, end + Vector2d(-3, 0)}};
  const std::vector<WallChain> chains = chains_of(walls, radians(30.0));
  ASSERT_EQ(chains.size(), 4u);
  EXPECT_EQ(chains[0].points.size(), 3u);
  EXPECT_NEAR(chains[0].length(), 20.0, 1e-12);
  EXPECT_NEAR(chains[1].length(), 10.0, 1e-12);
}

TEST(WallChains, GoRoundOnce) {
  std::vector<Vector2d> circle;
  for (int i = 0; i < 24; ++i) circle.emplace_back(5.0 * unit_vector(kTwoPi * i / 24));
  const std::vector<WallChain> chains = chains_of(outline(circle), radians(30.0));
  ASSERT_EQ(chains.size(), 1u);
  EXPECT_TRUE(chains.front().is_closed());
  EXPECT_EQ(chains.front().points.size(), 25u);
}

TEST(WallChains, PartsHaveTheirLengths) {
  const WallChain chain{{{0, 0}, {4, 0}, {4, 3}, {9, 3}}};
  const WallChain part = part_of(chain, 3.0, 8.5);
  ASSERT_EQ(part.points.size(), 4u);
  EXPECT_EQ(part.points.front(), Vector2d(3, 0));
  EXPECT_EQ(part.points.back(), Vector2d(5.5, 3));
  EXPECT_NEAR(part.length(), 5.5, 1e-12);
  EXPECT_EQ(part_of(chain, 0.0, chain.length()).points, chain.points);
  for (std::size_t i = 1; i < 30; ++i) {
    EXPECT_NEAR(densified(chain, 0.1 * static_cast<double>(i)).length(), 12.0, 1e-12);
  }
}

TEST(AsBuilt, IsThePlanWhereNothingIsAsked) {
  const World planned = pillars(3, 4);
  const World built = as_built(planned, {}, 5);
  EXPECT_TRUE(same(built.walls, planned.plan));
  EXPECT_TRUE(same(built.plan, planned.plan));
  EXPECT_EQ(long_plan_error({}), 0.0);
}

AsBuiltOptions everything() {
  AsBuiltOptions options;
  options.bend_m = 0.15;
  options.rough_m = 0.05;
  options.missing_ratio = 0.02;
  options.added_ratio = 0.02;
  options.chains_ratio = 0.1;
  options.distortion = 0.001;
  return options;
}

TEST(AsBuilt, FollowsItsSeed) {
  const World planned = pillars(3, 4);
  const World built = as_built(planned, everything(), 5);
  EXPECT_TRUE(same(built.walls, as_built(planned, everything(), 5).walls));
  EXPECT_FALSE(same(built.walls, as_built(planned, everything(), 6).walls));
  EXPECT_TRUE(same(built.plan, planned.plan));
}

/// RMS over seeds of how far the walls lie off the plan across, away from corners.
double rms_across(const AsBuiltOptions& options) {
  const World planned = from_plan({{{0, 0}, {400, 0}}});
  double squares = 0.0;
  double count = 0.0;
  for (std::uint64_t seed = 0; seed < 30; ++seed) {
    for (const Segment& wall : as_built(planned, options, seed).walls) {
      squares += wall.a.y() * wall.a.y();
      ++count;
    }
  }
  return std::sqrt(squares / count);
}

TEST(AsBuilt, WallsLieOffByTheSigmasAskedFor) {
  AsBuiltOptions bend;
  bend.bend_m = 0.15;
  EXPECT_NEAR(rms_across(bend), 0.15, 0.01);
  EXPECT_NEAR(long_plan_error(bend), 0.15, 1e-12);
  AsBuiltOptions rough;
  rough.rough_m = 0.05;
  EXPECT_NEAR(rms_across(rough), 0.05, 0.003);
  EXPECT_EQ(long_plan_error(rough), 0.0);
  AsBuiltOptions distorted;
  distorted.distortion = 0.002;
  EXPECT_NEAR(rms_across(distorted), long_plan_error(distorted), 0.04);
}

TEST(AsBuilt, StrainsThePlanAsMuchAsAskedFor) {
  AsBuiltOptions options;
  options.distortion = 0.002;
  const World planned = from_plan({{{0, 0}, {1000, 0}}});
  double squares = 0.0;
  double count = 0.0;
  for (std::uint64_t seed = 0; seed < 30; ++seed) {
    const std::vector<Segment> walls = as_built(planned, options, seed).walls;
    const double piece = 1000.0 / static_cast<double>(walls.size());
    for (const Segment& wall : walls) {
      const double strain = (wall.b.x() - wall.a.x()) / piece - 1.0;
      squares += strain * strain;
      ++count;
    }
  }
  EXPECT_NEAR(std::sqrt(squares / count), 0.002, 0.0002);
}

TEST(AsBuilt, BendsWallsAndKeepsThemJoined) {
  AsBuiltOptions options = everything();
  options.missing_ratio = 0.0;
  options.added_ratio = 0.0;
  options.chains_ratio = 0.0;
  const World built = as_built(pillars(3, 4), options, 2);
  std::map<std::pair<double, double>, int> ends;
  for (const Segment& wall : built.walls) {
    EXPECT_LE(wall.length(), 0.4);
    ++ends[{wall.a.x(), wall.a.y()}];
    ++ends[{wall.b.x(), wall.b.y()}];
  }
  for (const auto& [end, count] : ends) EXPECT_EQ(count, 2) << end.first << ", " << end.second;
}

TEST(AsBuilt, LacksTheShareThatIsMissing) {
  const World planned = pillars(6, 8);
  for (const double share : {0.02, 0.3, 1.0}) {
    AsBuiltOptions options;
    options.missing_ratio = share;
    const World built = as_built(planned, options, 3);
    EXPECT_NEAR(length(built.walls), (1.0 - share) * length(planned.plan), 1e-4);
    for (const Segment& wall : built.walls) {
      const Vector2d middle = 0.5 * (wall.a + wall.b);
      EXPECT_TRUE(std::any_of(planned.plan.begin(), planned.plan.end(),
                              [&](const Segment& s) { return distance(s, middle) < 1e-9; }));
    }
  }
}

TEST(AsBuilt, HasTheShareThatIsAddedAndNoneOnTheWay) {
  const World planned = pillars(6, 8);
  for (std::uint64_t seed = 0; seed < test::repeats(20); ++seed) {
    AsBuiltOptions options;
    options.added_ratio = 0.05;
    const World built = as_built(planned, options, seed);
    EXPECT_NEAR(length(built.walls) / length(planned.plan), 1.05, 1e-3);
    EXPECT_GE(clearance(built), options.clearance_m);
    EXPECT_EQ(count_loose_ends(planned.plan), 0);
    // Stubs end in the open; stoppings and masonry do not.
    EXPECT_GT(built.walls.size(), planned.plan.size() + 10);
  }
}

TEST(AsBuilt, DisplacesTheShareAskedForAndKeepsItJoined) {
  const World planned = pillars(6, 8);
  for (std::uint64_t seed = 0; seed < test::repeats(20); ++seed) {
    AsBuiltOptions options;
    options.chains_ratio = 0.1;
    options.chain_offset_m = 0.3;
    const World built = as_built(planned, options, seed);
    double off = 0.0;
    for (const Segment& wall : built.walls) {
      double nearest = 1e9;
      for (const Segment& s : planned.plan) {
        nearest = std::min(nearest, std::max(distance(s, wall.a), distance(s, wall.b)));
      }
      if (wall.length() > 1.0 && nearest > 1e-9) {
        EXPECT_NEAR(nearest, 0.3, 1e-9);
        off += wall.length();
      }
    }
    // To within half of the longest chain: a side of the panel.
    EXPECT_NEAR(off / length(planned.plan), 0.1, 0.5 * 166.0 / length(planned.plan));
    EXPECT_EQ(count_loose_ends(built.walls), 0);
  }
}

TEST(AsBuilt, KeepsItsWayClear) {
  const World planned = pillars(3, 4);
  const double before = clearance(planned);
  for (std::uint64_t seed = 0; seed < test::repeats(6); ++seed) {
    AsBuiltOptions smooth;
    smooth.bend_m = 0.3;
    smooth.distortion = 0.002;
    // The bend stretches an opening by its gradient: sigma √2 / reach = 5 %, four sigma at most.
    EXPECT_GE(clearance(as_built(planned, smooth, seed)), 0.8 * before);
    AsBuiltOptions all = everything();
    all.missing_ratio = 0.0;
    EXPECT_GE(clearance(as_built(planned, all, seed)), 0.8 * all.clearance_m - 4 * all.rough_m);
  }
}

TEST(AsBuilt, TurnsThePathWithTheField) {
  AsBuiltOptions options;
  options.bend_m = 0.3;
  World planned = from_plan({{{0, 3}, {100, 3}}});
  for (double x = 0.0; x < 100.0; x += 0.1) planned.path.push_back({x, 0.0, 0.0});
  const World built = as_built(planned, options, 4);
  for (std::size_t i = 1; i + 1 < built.path.size(); ++i) {
    const Vector2d along = built.path[i + 1].translation() - built.path[i - 1].translation();
    EXPECT_NEAR(angle_between(built.path[i].theta, std::atan2(along.y(), along.x())), 0.0, 1e-3);
  }
}

TEST(OffPlan, CutsThePlanAtTheCircleAndLeavesTheMine) {
  const World planned =
      from_plan({{{-10, 3}, {10, 3}}, {{-1, 0}, {1, 0}}, {{6, -1}, {6, 1}}, {{0, 0}, {0, 9}}});
  const World world = off_plan(planned, {0, 0}, 5.0);
  EXPECT_TRUE(same(world.walls, planned.walls));
  const std::vector<Segment> expected{
      {{-10, 3}, {-4, 3}}, {{4, 3}, {10, 3}}, {{6, -1}, {6, 1}}, {{0, 5}, {0, 9}}};
  ASSERT_EQ(world.plan.size(), expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i) {
    EXPECT_LT((world.plan[i].a - expected[i].a).norm(), 1e-12);
    EXPECT_LT((world.plan[i].b - expected[i].b).norm(), 1e-12);
  }
}

}  // namespace
}  // namespace adit
