#include "adit/visibility/visibility.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "support/casting.hpp"
#include "support/draws.hpp"

namespace adit {
namespace {

using testing::bearing_of;
using testing::cast;
using testing::grid_segments;
using testing::is_right;
using testing::kInfinity;
using testing::map_of;
using testing::Sight;

void expect_boundary(const Sight& sight, const VisibleInterval& interval, bool is_begin) {
  const Wall& wall = sight.map.walls()[static_cast<std::size_t>(interval.wall)];
  const Vector2d point = is_begin ? interval.begin : interval.end;
  const Boundary kind = is_begin ? interval.begin_kind : interval.end_kind;
  const int vertex = is_begin ? interval.begin_vertex : interval.end_vertex;
  EXPECT_LE(distance(wall.segment, point + sight.observer), 1e-9);
  EXPECT_LE(point.norm(), sight.max_range * (1.0 + 1e-9));
  if (kind == Boundary::vertex) {
    ASSERT_TRUE(vertex == wall.vertex_a || vertex == wall.vertex_b);
    const Vector2d expected =
        sight.map.vertices()[static_cast<std::size_t>(vertex)] - sight.observer;
    EXPECT_LE((expected - point).norm(), 1e-12);
    return;
  }
  EXPECT_EQ(vertex, -1);
  if (kind == Boundary::range_limit) {
    EXPECT_NEAR(point.norm(), sight.max_range, 1e-7 * sight.max_range);
    return;
  }
  // Just outside, something nearer must be seen, and the wall itself must still be there.
  const double outside = bearing_of(point) + (is_begin ? -1e-8 : 1e-8);
  EXPECT_LE(cast(sight.map, sight.observer, outside, kInfinity), point.norm() * (1.0 + 1e-4));
  EXPECT_GT((point + sight.observer - wall.segment.a).norm(), 1e-11);
  EXPECT_GT((point + sight.observer - wall.segment.b).norm(), 1e-11);
}

void expect_intervals(const Sight& sight, std::span<const VisibleInterval> intervals) {
  double last_end = -kPi;
  for (const VisibleInterval& interval : intervals) {
    EXPECT_GT(cross(interval.begin, interval.end), 0.0);
    double begin = bearing_of(interval.begin);
    if (begin > kPi - 1e-11) begin -= kTwoPi;
    double end = bearing_of(interval.end);
    if (end < begin) {
      end += kTwoPi;
      EXPECT_EQ(&interval, &intervals.back()) << "spans the bearing pi but is not the last";
      EXPECT_LE(end - kTwoPi, bearing_of(intervals.front().begin) + 1e-11);
    }
    EXPECT_GE(begin, last_end - 1e-11) << "overlap or disorder";
    last_end = end;
    expect_boundary(sight, interval, true);
    expect_boundary(sight, interval, false);
    for (const double share : {0.25, 0.5, 0.75}) {
      const Vector2d inside = interval.begin + share * (interval.end - interval.begin);
      if (end - begin < 1e-6) continue;
      EXPECT_TRUE(
          is_right(inside.norm(), sight.map, sight.observer, bearing_of(inside), sight.max_range));
    }
  }
}

/// Compares a sweep with casting: its intervals, and single beams at, beside and between wall
/// ends.
void expect_right(const Sight& sight, Visibility& visibility) {
  visibility.sweep(sight.map, sight.observer, sight.max_range);
  expect_intervals(sight, visibility.intervals());
  std::vector<double> bearings{0.0, 1.0, 2.0, kPi, -kPi, -1.0};
  const std::span<const Vector2d> vertices = sight.map.vertices();
  for (std::size_t i = 0; i < vertices.size(); i += 1 + vertices.size() / 25) {
    const double bearing = bearing_of(vertices[i] - sight.observer);
    for (const double nudge : {0.0, -1e-5, 1e-5, 0.1}) bearings.push_back(bearing + nudge);
  }
  for (const double bearing : bearings) {
    double range = 0.0;
    visibility.ranges(bearing, 1.0, {&range, 1});
    EXPECT_TRUE(is_right(range, sight.map, sight.observer, bearing, sight.max_range));
  }
}

/// An observer where it hurts: on a grid point, on a wall, on a vertex, in line with walls; or
/// anywhere.
Vector2d awkward_observer(std::mt19937_64& random, const LineMap& map, int size) {
  std::uniform_int_distribution<int> choice(0, 4);
  std::uniform_real_distribution<double> any(-1.0, size + 1.0);
  std::uniform_int_distribution<int> at(0, size);
  const int chosen = choice(random);
  if (chosen == 0) return {at(random), at(random)};
  if (chosen == 1) return {at(random) + 0.5, at(random)};
  if (map.empty() || chosen == 2) return {any(random), any(random)};
  const Wall& wall = map.walls()[random() % map.walls().size()];
  if (chosen == 3) return map.vertices()[static_cast<std::size_t>(wall.vertex_a)];
  const double share = 0.1 * at(random);
  return wall.segment.a + share * (wall.segment.b - wall.segment.a);
}

double awkward_range(std::mt19937_64& random) {
  constexpr double kRanges[] = {0.5, 1.0, 2.0, 3.0, 5.0, 7.3, 100.0, 1e6};
  return kRanges[random() % std::size(kRanges)];
}

TEST(Visibility, GridWorldsLikeCasting) {
  std::mt19937_64 random(1);
  Visibility visibility;
  for (int world = 0; world < 3000 && !HasFailure(); ++world) {
    const int size = 2 + static_cast<int>(random() % 8);
    Sight sight;
    sight.map = map_of(grid_segments(random, static_cast<int>(random() % 24), size));
    sight.observer = awkward_observer(random, sight.map, size);
    sight.max_range = awkward_range(random);
    SCOPED_TRACE(world);
    expect_right(sight, visibility);
  }
}

TEST(Visibility, TurnedGridWorldsLikeCasting) {
  std::mt19937_64 random(2);
  Visibility visibility;
  std::uniform_real_distribution<double> any(-kPi, kPi);
  for (int world = 0; world < 2000 && !HasFailure(); ++world) {
    const Pose2 turned{1000.0 * any(random), 1000.0 * any(random), any(random)};
    std::vector<Segment> segments = grid_segments(random, static_cast<int>(random() % 24), 6);
    for (Segment& s : segments) s = {turned * s.a, turned * s.b};
    Sight sight;
    sight.map = map_of(segments);
    sight.observer = turned * test::drawn<2>([&] { return static_cast<double>(random() % 7); });
    sight.max_range = awkward_range(random);
    SCOPED_TRACE(world);
    // On a wall up to rounding: casting cannot tell on which side it stands.
    bool on_wall = false;
    for (const Wall& w : sight.map.walls()) on_wall |= distance(w.segment, sight.observer) < 1e-8;
    if (!on_wall) expect_right(sight, visibility);
  }
}

TEST(Visibility, RandomWorldsLikeCasting) {
  std::mt19937_64 random(3);
  Visibility visibility;
  std::uniform_real_distribution<double> any(0.0, 20.0);
  for (int world = 0; world < 1000 && !HasFailure(); ++world) {
    std::vector<Segment> segments;
    const std::size_t count = random() % 60;
    for (std::size_t i = 0; i < count; ++i) {
      const Vector2d a = test::drawn<2>([&] { return any(random); });
      segments.push_back({a, a + 0.3 * test::drawn<2>([&] { return any(random) - 10.0; })});
    }
    Sight sight;
    sight.map = map_of(segments);
    sight.observer = {any(random), any(random)};
    sight.max_range = awkward_range(random);
    SCOPED_TRACE(world);
    expect_right(sight, visibility);
  }
}

// Many walls within range, in rings: what is hidden by near ones must not matter, what shows
// through a gap must.
TEST(Visibility, DensePlansLikeCasting) {
  std::mt19937_64 random(4);
  Visibility visibility;
  std::uniform_real_distribution<double> any(0.0, 60.0);
  for (int world = 0; world < 30 && !HasFailure(); ++world) {
    std::vector<Segment> segments;
    for (int x = 0; x < 60; x += 4) {
      for (int y = 0; y < 60; y += 4) {
        if (random() % 8 == 0) continue;
        const Vector2d c[] = {{x, y}, {x + 2.0, y}, {x + 2.0, y + 2.5}, {x, y + 2.5}};
        for (std::size_t i = 0; i < 4; ++i) segments.push_back({c[i], c[(i + 1) % 4]});
      }
    }
    Sight sight;
    sight.map = map_of(segments);
    sight.observer = {any(random), any(random)};
    sight.max_range = 45.0;
    SCOPED_TRACE(world);
    expect_right(sight, visibility);
  }
}

TEST(Visibility, EmptyMapAndBadArgumentsSeeNothing) {
  Visibility visibility;
  const LineMap wall = map_of({{Vector2d(1, -1), Vector2d(1, 1)}});
  const double nan = std::numeric_limits<double>::quiet_NaN();
  visibility.sweep(LineMap{}, Vector2d::Zero(), 50.0);
  EXPECT_TRUE(visibility.intervals().empty());
  visibility.sweep(map_of({}), Vector2d::Zero(), 50.0);
  EXPECT_TRUE(visibility.intervals().empty());
  for (const double range : {0.0, -1.0, nan}) {
    visibility.sweep(wall, Vector2d::Zero(), range);
    EXPECT_TRUE(visibility.intervals().empty());
  }
  visibility.sweep(wall, Vector2d(nan, 0.0), 50.0);
  EXPECT_TRUE(visibility.intervals().empty());
  std::vector<double> ranges(10, 0.0);
  std::vector<int> walls(10, 7);
  visibility.ranges(0.0, 0.1, ranges, walls);
  for (const double range : ranges) EXPECT_EQ(range, kInfinity);
  for (const int hit : walls) EXPECT_EQ(hit, -1);
}

TEST(Visibility, UnlimitedRangeSeesAll) {
  Visibility visibility;
  visibility.sweep(map_of({{Vector2d(1e5, -1), Vector2d(1e5, 1)}}), Vector2d::Zero(), kInfinity);
  EXPECT_EQ(visibility.intervals().size(), 1u);
}

TEST(Visibility, RoomIsTiledByItsWalls) {
  const LineMap room = map_of({{Vector2d(-3, -2), Vector2d(3, -2)},
                               {Vector2d(3, -2), Vector2d(3, 2)},
                               {Vector2d(3, 2), Vector2d(-3, 2)},
                               {Vector2d(-3, 2), Vector2d(-3, -2)}});
  Visibility visibility;
  visibility.sweep(room, Vector2d(0.5, 0.5), 50.0);
  const std::span<const VisibleInterval> seen = visibility.intervals();
  ASSERT_EQ(seen.size(), 4u);
  for (std::size_t i = 0; i < 4; ++i) {
    const VisibleInterval& next = seen[(i + 1) % 4];
    EXPECT_EQ(seen[i].end_kind, Boundary::vertex);
    EXPECT_EQ(seen[i].end_vertex, next.begin_vertex);
    EXPECT_EQ(seen[i].end, next.begin);
  }
  // The left wall spans the bearing pi, so it comes last and whole.
  EXPECT_EQ(seen.back().begin, Vector2d(-3.5, 1.5));
  EXPECT_EQ(seen.back().end, Vector2d(-3.5, -2.5));
}

TEST(Visibility, TellsWhatEndsAnInterval) {
  // A near wall before a far one that leaves the range on both sides.
  const LineMap map =
      map_of({{Vector2d(2, -1), Vector2d(2, 1)}, {Vector2d(4, -100), Vector2d(4, 100)}});
  Visibility visibility;
  visibility.sweep(map, Vector2d::Zero(), 5.0);
  const std::span<const VisibleInterval> seen = visibility.intervals();
  ASSERT_EQ(seen.size(), 3u);
  EXPECT_EQ(seen[0].begin_kind, Boundary::range_limit);
  EXPECT_NEAR(seen[0].begin.y(), -3.0, 1e-12);
  EXPECT_EQ(seen[0].end_kind, Boundary::occluded);
  EXPECT_NEAR(seen[0].end.y(), -2.0, 1e-12);
  EXPECT_EQ(seen[1].begin_kind, Boundary::vertex);
  EXPECT_EQ(seen[1].begin, Vector2d(2, -1));
  EXPECT_EQ(seen[1].end_kind, Boundary::vertex);
  EXPECT_EQ(seen[2].begin_kind, Boundary::occluded);
  EXPECT_EQ(seen[2].end_kind, Boundary::range_limit);
  EXPECT_EQ(seen[0].wall, seen[2].wall);
}

TEST(Visibility, ObserverOnAWallSeesBothSidesOfIt) {
  const LineMap map = map_of({{Vector2d(-5, 0), Vector2d(5, 0)},
                              {Vector2d(-1, 2), Vector2d(1, 2)},
                              {Vector2d(-1, -3), Vector2d(1, -3)}});
  Visibility visibility;
  visibility.sweep(map, Vector2d::Zero(), 50.0);
  ASSERT_EQ(visibility.intervals().size(), 2u);
  double ranges[2];
  visibility.ranges(-0.5 * kPi, kPi, ranges);
  EXPECT_NEAR(ranges[0], 3.0, 1e-12);
  EXPECT_NEAR(ranges[1], 2.0, 1e-12);
}

TEST(Visibility, MineCoordinatesWithSevenDigits) {
  const Vector2d far(4512345.678, 5234567.891);
  std::vector<Segment> segments = {{Vector2d(-3, -2), Vector2d(3, -2)},
                                   {Vector2d(3, -2), Vector2d(3, 2)},
                                   {Vector2d(3, 2), Vector2d(-3, 2)},
                                   {Vector2d(-3, 2), Vector2d(-3, -2)}};
  for (Segment& s : segments) s = {s.a + far, s.b + far};
  Visibility visibility;
  visibility.sweep(map_of(segments), far, 50.0);
  ASSERT_EQ(visibility.intervals().size(), 4u);
  double ranges[4];
  visibility.ranges(0.0, 0.5 * kPi, ranges);
  EXPECT_NEAR(ranges[0], 3.0, 1e-8);
  EXPECT_NEAR(ranges[1], 2.0, 1e-8);
}

}  // namespace
}  // namespace adit
