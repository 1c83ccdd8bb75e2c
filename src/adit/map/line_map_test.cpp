#include "adit/map/line_map.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "support/plan_checks.hpp"

namespace adit {
namespace {

struct Cleaned {
  LineMap map;
  MapReport report;
};

Cleaned clean(const std::vector<Segment>& raw, const LineMapOptions& options = {}) {
  Cleaned result;
  result.map = LineMap::build(raw, options, &result.report);
  EXPECT_EQ(test::faults_of(result.map), "");
  EXPECT_EQ(result.report.input, static_cast<std::int64_t>(raw.size()));
  EXPECT_EQ(result.report.output, static_cast<std::int64_t>(result.map.walls().size()));
  return result;
}

double total_length(const LineMap& map) {
  double sum = 0.0;
  for (const Wall& wall : map.walls()) sum += wall.segment.length();
  return sum;
}

int vertex_near(const LineMap& map, const Vector2d& point, double within = 1e-9) {
  int found = -1;
  for (std::size_t v = 0; v < map.vertices().size(); ++v) {
    if ((map.vertices()[v] - point).norm() <= within) found = static_cast<int>(v);
  }
  return found;
}

std::size_t degree_at(const LineMap& map, const Vector2d& point, double within = 1e-9) {
  const int vertex = vertex_near(map, point, within);
  return vertex < 0 ? 0 : map.walls_at(vertex).size();
}

TEST(LineMap, of_nothing_is_empty) {
  const auto [map, report] = clean({});
  EXPECT_TRUE(map.empty());
  EXPECT_TRUE(map.bounds().is_empty());
  std::vector<int> found;
  map.near({0.0, 0.0}, 1e9, found);
  LineMap{}.near({0.0, 0.0}, 1e9, found);
  EXPECT_TRUE(found.empty());
}

TEST(LineMap, drops_and_counts_what_is_no_wall) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  constexpr double kInf = std::numeric_limits<double>::infinity();
  const auto [map, report] = clean({{{kNan, 0.0}, {1.0, 0.0}},
                                    {{0.0, 0.0}, {1.0, -kInf}},
                                    {{0.0, 1e300}, {1.0, 0.0}},
                                    {{2.0, 2.0}, {2.0, 2.0}},
                                    {{3.0, 3.0}, {3.0, 3.005}},
                                    {{0.0, 0.0}, {1.0, 0.0}}});
  EXPECT_EQ(report.not_finite, 3);
  EXPECT_EQ(report.zero_length, 2);
  ASSERT_EQ(map.walls().size(), 1U);
  EXPECT_EQ(map.vertices().size(), 2U);
}

TEST(LineMap, joins_ends_that_nearly_meet) {
  const auto [map, report] = clean({{{0.0, 0.0}, {4.0, 0.0}}, {{4.006, 0.005}, {4.0, 3.0}}});
  EXPECT_EQ(map.vertices().size(), 3U);
  EXPECT_EQ(report.snapped_ends, 1);
  EXPECT_EQ(degree_at(map, {4.0, 0.0}, 0.01), 2U);
}

TEST(LineMap, leaves_ends_apart_that_are_farther) {
  const auto [map, report] = clean({{{0.0, 0.0}, {4.0, 0.0}}, {{4.011, 0.0}, {8.0, 3.0}}});
  EXPECT_EQ(map.vertices().size(), 4U);
  EXPECT_EQ(report.snapped_ends, 0);
}

TEST(LineMap, does_not_let_a_chain_of_near_ends_drift) {
  std::vector<Segment> raw;  // 200 stubs, their feet 6 mm apart: each is near the next
  for (int i = 0; i < 200; ++i) raw.push_back({{0.006 * i, 0.0}, {0.006 * i, 1.0 + 0.1 * i}});
  const auto [map, report] = clean(raw);
  for (const Segment& s : raw) {
    double nearest = 1.0;
    for (const Vector2d& vertex : map.vertices())
      nearest = std::min(nearest, (vertex - s.a).norm());
    EXPECT_LE(nearest, 0.01);
  }
  EXPECT_LE(test::farthest_sample(raw, test::segments_of(map)), 0.02);
}

// The wall stays straight; the stub that misses it, or runs past it, is led to it.
TEST(LineMap, makes_a_vertex_where_a_stub_nearly_touches_a_wall) {
  for (const double gap : {0.008, 0.0, -0.008}) {
    const auto [map, report] = clean({{{0.0, 0.0}, {10.0, 0.0}}, {{3.0, gap}, {3.0, 2.0}}});
    EXPECT_EQ(map.walls().size(), 3U) << gap;
    EXPECT_EQ(degree_at(map, {3.0, 0.0}), 3U) << gap;
    EXPECT_EQ(report.t_junctions, 1) << gap;
    EXPECT_EQ(report.crossings, 0) << gap;
  }
}

TEST(LineMap, leaves_a_door_open) {
  const auto [map, report] = clean({{{0.0, 0.0}, {10.0, 0.0}}, {{3.0, 0.02}, {3.0, 2.0}}});
  EXPECT_EQ(map.walls().size(), 2U);
  EXPECT_EQ(report.t_junctions, 0);
}

TEST(LineMap, splits_both_walls_at_a_crossing) {
  const auto [map, report] = clean({{{0.0, 0.0}, {10.0, 10.0}}, {{0.0, 10.0}, {10.0, 0.0}}});
  EXPECT_EQ(map.walls().size(), 4U);
  EXPECT_EQ(degree_at(map, {5.0, 5.0}), 4U);
  EXPECT_EQ(report.crossings, 1);
}

TEST(LineMap, takes_crossings_that_nearly_coincide_as_one) {
  const auto [map, report] =
      clean({{{-5.0, 0.0}, {5.0, 0.0}}, {{0.0, -5.0}, {0.0, 5.0}}, {{-5.0, -4.996}, {5.0, 5.004}}});
  EXPECT_EQ(map.walls().size(), 6U);
  EXPECT_EQ(degree_at(map, {0.0, 0.0}, 0.01), 6U);
}

TEST(LineMap, puts_a_stub_at_a_crossing_onto_it_and_keeps_the_walls_straight) {
  const auto [map, report] =
      clean({{{-5.0, 0.0}, {5.0, 0.0}}, {{0.0, -5.0}, {0.0, 5.0}}, {{0.004, 0.003}, {4.0, 3.0}}});
  EXPECT_EQ(map.walls().size(), 5U);
  EXPECT_EQ(degree_at(map, {0.0, 0.0}), 5U);
}

TEST(LineMap, keeps_one_of_walls_drawn_more_than_once) {
  const auto [map, report] =
      clean({{{0.0, 0.0}, {4.0, 1.0}}, {{4.0, 1.0}, {0.0, 0.0}}, {{0.003, 0.0}, {4.0, 0.996}}});
  EXPECT_EQ(map.walls().size(), 1U);
  EXPECT_EQ(report.duplicates, 2);
}

TEST(LineMap, keeps_overlapping_parts_once) {
  const std::vector<std::vector<Segment>> drawings = {
      {{{0.0, 0.0}, {6.0, 0.0}}, {{4.0, 0.0}, {10.0, 0.0}}},                            // in part
      {{{0.0, 0.0}, {10.0, 0.0}}, {{7.0, 0.0}, {3.0, 0.0}}},                            // inside
      {{{0.0, 0.0}, {10.0, 0.0}}, {{0.0, 0.0}, {3.0, 0.0}}},                            // one end
      {{{0.0, 0.0}, {10.0, 0.0}}, {{2.0, 0.0}, {6.0, 0.0}}, {{4.0, 0.0}, {8.0, 0.0}}},  // three
      {{{0.0, 0.0}, {6.0, 0.001}}, {{4.0, -0.001}, {10.0, 0.0}}},                       // sloppy
  };
  for (const auto& raw : drawings) {
    const auto [map, report] = clean(raw);
    EXPECT_EQ(map.walls().size(), 1U);
    EXPECT_NEAR(total_length(map), 10.0, 1e-5);
    EXPECT_GE(report.duplicates, 1);
  }
}

TEST(LineMap, makes_one_wall_of_many_short_pieces) {
  std::vector<Segment> raw;
  const auto point = [](int i) { return Vector2d(0.1 * i, i % 2 == 0 ? 0.0 : 0.001); };
  for (int i = 0; i < 100; ++i) raw.push_back({point(i), point(i + 1)});
  const auto [map, report] = clean(raw);
  EXPECT_EQ(map.walls().size(), 1U);
  EXPECT_EQ(report.merged, 99);
}

TEST(LineMap, keeps_the_corners_of_a_loop_in_pieces) {
  std::vector<Segment> raw;
  for (int i = 0; i < 40; ++i) {
    const auto point = [](int k) {
      const Vector2d along(0.5 * (k % 10), 0.0);
      return RigidTransform({0.0, 0.0, kPi / 2.0 * (k / 10)}).point(along - Vector2d(2.5, 2.5));
    };
    raw.push_back({point(i), point((i + 1) % 40)});
  }
  const auto [map, report] = clean(raw);
  EXPECT_EQ(map.walls().size(), 4U);
  EXPECT_EQ(report.merged, 36);
  EXPECT_NEAR(total_length(map), 20.0, 1e-9);
}

TEST(LineMap, does_not_merge_over_a_junction) {
  const auto [map, report] =
      clean({{{0.0, 0.0}, {5.0, 0.0}}, {{5.0, 0.0}, {9.0, 0.0}}, {{5.0, 0.0}, {5.0, 5.0}}});
  EXPECT_EQ(map.walls().size(), 3U);
}

TEST(LineMap, does_not_let_a_gentle_curve_merge_away) {
  for (const double radius : {1.0, 20.0, 500.0}) {
    std::vector<Segment> raw;
    const double step = 0.5 / radius;
    for (double angle = 0.0; angle < 3.0 && raw.size() < 3000; angle += step) {
      raw.push_back({unit_vector(angle) * radius, unit_vector(angle + step) * radius});
    }
    const auto [map, report] = clean(raw);
    EXPECT_LE(test::farthest_sample(raw, test::segments_of(map)), 0.002 + 1e-9) << radius;
    EXPECT_LE(test::farthest_sample(test::segments_of(map), raw), 0.002 + 1e-9) << radius;
    EXPECT_GT(map.walls().size(), 2U) << radius;
  }
}

TEST(LineMap, keeps_millimetres_of_seven_digit_coordinates) {
  const Vector2d mine(512345.678, 4500123.456);
  const auto at = [&](double x, double y) { return Vector2d(mine + Vector2d(x, y)); };
  const auto [map, report] = clean({{at(0.0, 0.0), at(10.0, 0.0)},
                                    {at(10.0, 0.0), at(10.0, 7.0)},
                                    {at(4.0, 0.004), at(4.0, 5.0)},
                                    {at(2.0, 4.0), at(6.0, 4.0)}});
  EXPECT_EQ(map.walls().size(), 7U);
  EXPECT_GE(vertex_near(map, at(10.0, 0.0), 0.0), 0) << "an end in order must not move at all";
  EXPECT_EQ(degree_at(map, at(4.0, 0.0), 1e-8), 3U);
  EXPECT_EQ(degree_at(map, at(4.0, 4.0), 1e-8), 4U);
}

TEST(LineMap, finds_millimetre_walls_where_asked_to) {
  LineMapOptions exact;
  exact.snap_m = 0.0;
  exact.merge_offset_m = 0.0;
  const auto [map, report] =
      clean({{{0.0, 0.0}, {0.002, 0.0}}, {{0.001, -0.001}, {0.001, 0.001}}}, exact);
  EXPECT_EQ(map.walls().size(), 4U);
}

TEST(LineMap, is_not_upset_by_tolerances_that_are_none) {
  LineMapOptions broken;
  broken.snap_m = std::numeric_limits<double>::quiet_NaN();
  broken.merge_offset_m = -1.0;
  EXPECT_EQ(clean({{{0.0, 0.0}, {2.0, 0.0}}, {{1.0, -1.0}, {1.0, 1.0}}}, broken).map.walls().size(),
            4U);
  broken.snap_m = std::numeric_limits<double>::infinity();
  EXPECT_TRUE(clean({{{0.0, 0.0}, {2.0, 0.0}}}, broken).map.empty());
}

TEST(LineMap, knows_its_bounds) {
  const auto [map, report] = clean({{{-1.0, 2.0}, {4.0, 3.0}}, {{0.0, -5.0}, {1.0, -4.0}}});
  EXPECT_EQ(map.bounds().min, Vector2d(-1.0, -5.0));
  EXPECT_EQ(map.bounds().max, Vector2d(4.0, 3.0));
}

TEST(LineMap, has_the_identity_of_its_build) {
  const std::vector<Segment> walls = {{{0, 0}, {5, 0}}, {{5, 0}, {5, 4}}};
  EXPECT_EQ(LineMap{}.identity(), nullptr);
  LineMap map = LineMap::build(walls);
  const LineMap copy = map;
  ASSERT_NE(map.identity(), nullptr);
  EXPECT_EQ(copy.identity(), map.identity());
  // Another build is another map: of the same walls, in the same place, or where one was.
  const auto held = map.identity();
  for (int i = 0; i < 100; ++i) {
    map = LineMap::build(walls);
    EXPECT_NE(map.identity(), held);
  }
}

TEST(LineMap, near_appends_what_touches_the_circle) {
  const auto [map, report] = clean({{{0.0, 1.0}, {1.0, 1.0}}, {{0.0, 3.0}, {1.0, 3.0}}});
  std::vector<int> found{-7};
  map.near({0.0, 0.0}, 1.0, found);
  ASSERT_EQ(found.size(), 2U);
  EXPECT_EQ(found[0], -7);
  EXPECT_DOUBLE_EQ(map.walls()[static_cast<std::size_t>(found[1])].segment.a.y(), 1.0);
  found.clear();
  map.near({0.0, 0.0}, 0.99, found);
  map.near({0.0, 0.0}, -1.0, found);
  map.near({std::numeric_limits<double>::quiet_NaN(), 0.0}, 5.0, found);
  EXPECT_TRUE(found.empty());
  map.near({0.0, 0.0}, std::numeric_limits<double>::infinity(), found);
  EXPECT_EQ(found, (std::vector<int>{0, 1}));
}

}  // namespace
}  // namespace adit
