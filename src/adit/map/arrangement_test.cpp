#include "adit/map/arrangement.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

namespace adit {
namespace {

constexpr CleaningTolerances kTolerances{0.01, 1e-5, 0.002};

PlanGraph plan_of(const std::vector<Segment>& segments) {
  PlanGraph plan;
  for (const Segment& s : segments) {
    const int a = static_cast<int>(plan.vertices.size());
    plan.vertices.push_back(s.a);
    plan.vertices.push_back(s.b);
    plan.edges.push_back({a, a + 1});
  }
  return plan;
}

MapReport resolve(PlanGraph& plan, std::vector<int> suspects, double touch = 0.0) {
  MapReport report;
  resolve_meetings(plan, suspects, touch, kTolerances, report);
  return report;
}

std::size_t degree(const PlanGraph& plan, int vertex) {
  return incidence_of(plan.edges, plan.vertices.size()).at(vertex).size();
}

TEST(ResolveMeetings, splits_a_suspect_and_what_it_crosses) {
  for (const int suspect : {0, 1}) {
    PlanGraph plan = plan_of({{{0.0, 0.0}, {4.0, 0.0}}, {{1.0, -1.0}, {1.0, 1.0}}});
    EXPECT_EQ(resolve(plan, {suspect}).crossings, 1);
    ASSERT_EQ(plan.vertices.size(), 5U);
    EXPECT_EQ(degree(plan, 4), 4U);
    EXPECT_NEAR((plan.vertices[4] - Vector2d(1.0, 0.0)).norm(), 0.0, 1e-12);
  }
}

TEST(ResolveMeetings, does_not_look_where_nothing_is_suspected) {
  PlanGraph plan = plan_of({{{0.0, 0.0}, {4.0, 0.0}}, {{1.0, -1.0}, {1.0, 1.0}}});
  EXPECT_EQ(resolve(plan, {}).crossings, 0);
  EXPECT_EQ(plan.edges.size(), 2U);
}

TEST(ResolveMeetings, splits_a_wall_at_all_that_it_crosses) {
  std::vector<Segment> segments{{{0.0, 0.0}, {11.0, 0.0}}};
  for (int i = 1; i <= 10; ++i) segments.push_back({{1.0 * i, -1.0}, {1.0 * i, 1.0}});
  PlanGraph plan = plan_of(segments);
  EXPECT_EQ(resolve(plan, {0}).crossings, 10);
  EXPECT_EQ(plan.edges.size(), 31U);
}

TEST(ResolveMeetings, splits_at_an_end_that_touches) {
  for (const int suspect : {0, 1}) {
    PlanGraph plan = plan_of({{{0.0, 0.0}, {4.0, 0.0}}, {{1.0, 4e-6}, {1.0, 1.0}}});
    EXPECT_EQ(resolve(plan, {suspect}).t_junctions, 1);
    EXPECT_EQ(degree(plan, 2), 3U);
  }
}

TEST(ResolveMeetings, touches_as_far_as_told) {
  const std::vector<Segment> segments{{{0.0, 0.0}, {4.0, 0.0}}, {{1.0, 0.008}, {1.0, 1.0}}};
  PlanGraph plan = plan_of(segments);
  EXPECT_EQ(resolve(plan, {0, 1}).t_junctions, 0);
  EXPECT_EQ(resolve(plan, {0, 1}, 0.01).t_junctions, 1);
  EXPECT_EQ(degree(plan, 2), 3U);
}

// Each end is within reach of the wall as bent by the one before; the wall must not follow them
// all.
TEST(ResolveMeetings, repeated_touches_do_not_carry_a_wall_away) {
  std::vector<Segment> segments{{{0.0, 0.0}, {100.0, 0.0}}};
  for (int i = 1; i <= 9; ++i) {
    const double x = 50.0 + i;
    segments.push_back({{x, 0.008 * i}, {x, 5.0}});
  }
  PlanGraph plan = plan_of(segments);
  std::vector<int> all(segments.size());
  std::iota(all.begin(), all.end(), 0);
  resolve(plan, all, 0.01);
  for (const Edge& edge : plan.edges) {
    const Segment s = segment_of(edge, plan.vertices);
    if (std::abs(s.b.x() - s.a.x()) < 0.5) continue;  // a stub
    EXPECT_LE(std::max(s.a.y(), s.b.y()), 0.01);
  }
}

TEST(ResolveMeetings, splits_what_lies_upon_each_other) {
  PlanGraph plan = plan_of({{{0.0, 0.0}, {6.0, 0.0}}, {{4.0, 0.0}, {10.0, 0.0}}});
  resolve(plan, {0});
  EXPECT_EQ(plan.edges.size(), 4U);
  EXPECT_EQ(drop_duplicates(plan), 1);
  EXPECT_EQ(plan.edges.size(), 3U);
}

}  // namespace
}  // namespace adit
