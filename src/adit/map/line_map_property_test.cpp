#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <random>

#include "adit/map/line_map.hpp"
#include "support/draws.hpp"
#include "support/plan_checks.hpp"

namespace adit {
namespace {

// Plans as dirty as they come, from a seed: each wall is new, or a spoilt relation of an earlier
// one.
class DirtyPlan {
 public:
  DirtyPlan(std::uint64_t seed, const Vector2d& origin) : random_(seed), origin_(origin) {}

  std::vector<Segment> draw(int count) {
    while (static_cast<int>(walls_.size()) < count) walls_.push_back(next());
    return walls_;
  }

 private:
  double uniform(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random_);
  }
  int die(int sides) { return std::uniform_int_distribution<int>(0, sides - 1)(random_); }
  Vector2d slip(double by) { return {uniform(-by, by), uniform(-by, by)}; }
  Vector2d somewhere() {
    return origin_ + test::drawn<2>([&] { return uniform(0.0, 8.0); });
  }
  Vector2d lattice() {
    const Vector2d off = slip(0.004);
    return origin_ + test::drawn<2>([&] { return die(5) * 2.0; }) + off;
  }
  Segment earlier() {
    return walls_[static_cast<std::size_t>(die(static_cast<int>(walls_.size())))];
  }
  Vector2d on(const Segment& s) { return s.a + (s.b - s.a) * uniform(-0.2, 1.2); }
  Vector2d beside(const Segment& s, double by) {
    const Vector2d off = slip(by);
    return on(s) + off;
  }

  Segment next() {
    const Segment old = walls_.empty() ? Segment{somewhere(), somewhere()} : earlier();
    switch (die(10)) {
      case 0:
        return {lattice(), lattice()};
      case 1:
        return {old.b, old.a};  // drawn twice
      case 2:
        return {on(old), on(old)};  // overlapping
      case 3:
        return {old.a + slip(0.006), old.b + slip(0.006)};  // beside itself
      case 4:
        return {beside(old, 0.012), somewhere()};  // T with a gap
      case 5:
        return {old.b + slip(0.009), somewhere()};  // chain with gaps
      case 6:
        return {old.b, old.b + slip(0.03)};  // crumbs
      case 7:
        return {on(old), beside(old, 0.004)};  // shallow crossing
      case 8:
        return {old.a, old.a};  // nothing
      default:
        return {somewhere(), somewhere()};
    }
  }

  std::mt19937_64 random_;
  Vector2d origin_;
  std::vector<Segment> walls_;
};

std::vector<Segment> dirty_plan(const Vector2d& origin) {
  const auto seed = *rc::gen::arbitrary<std::uint64_t>();
  const auto count = *rc::gen::inRange(0, 60);
  return DirtyPlan(seed, origin).draw(count);
}

RC_GTEST_PROP(LineMapProperty, walls_meet_only_at_vertices, ()) {
  const std::string faults = test::faults_of(LineMap::build(dirty_plan({0.0, 0.0})));
  RC_ASSERT(faults == "");
}

// What only one plan in a thousand brings about.
TEST(LineMapSweep, walls_meet_only_at_vertices) {
  for (std::uint64_t seed = 0; seed < 3000; ++seed) {
    const auto raw = DirtyPlan(seed, {0.0, 0.0}).draw(seed % 20 == 0 ? 100 : 20);
    ASSERT_EQ(test::faults_of(LineMap::build(raw)), "") << "seed " << seed;
  }
}

// Ends near a wall end in it: few walls are bent so much by others that this fails.
TEST(LineMapSweep, leaves_hardly_a_gap) {
  int vertices = 0;
  int gaps = 0;
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    const LineMap map = LineMap::build(DirtyPlan(seed, {0.0, 0.0}).draw(30));
    for (int v = 0; v < static_cast<int>(map.vertices().size()); ++v, ++vertices) {
      const Vector2d& point = map.vertices()[static_cast<std::size_t>(v)];
      gaps += std::any_of(map.walls().begin(), map.walls().end(), [&](const Wall& wall) {
        return wall.vertex_a != v && wall.vertex_b != v && distance(wall.segment, point) < 0.0099;
      });
    }
  }
  EXPECT_GT(vertices, 5000);
  EXPECT_LT(gaps, vertices / 300);
}

RC_GTEST_PROP(LineMapProperty, holds_in_mine_coordinates, ()) {
  const std::string faults = test::faults_of(LineMap::build(dirty_plan({5.1e5, 4.5e6})));
  RC_ASSERT(faults == "");
}

RC_GTEST_PROP(LineMapProperty, holds_for_any_tolerances, ()) {
  LineMapOptions options;
  options.snap_m = *rc::gen::element(0.0, 0.001, 0.05, 0.3);
  options.merge_offset_m = *rc::gen::element(0.0, 0.002, 0.1);
  const double tolerance = options.snap_m > 0.0 ? 1e-4 * options.snap_m : 1e-13;
  const std::string faults =
      test::faults_of(LineMap::build(dirty_plan({0.0, 0.0}), options), tolerance);
  RC_ASSERT(faults == "");
}

RC_GTEST_PROP(LineMapProperty, keeps_the_geometry, ()) {
  const auto raw = dirty_plan({0.0, 0.0});
  const LineMapOptions options;
  const auto cleaned = test::segments_of(LineMap::build(raw, options));
  const double bound = 4.0 * options.snap_m + options.merge_offset_m;
  std::vector<Segment> walls = raw;  // crumbs may vanish
  std::erase_if(walls, [&](const Segment& s) { return s.length() <= 3.0 * options.snap_m; });
  if (!walls.empty()) RC_ASSERT(test::farthest_sample(walls, cleaned) <= bound);
  RC_ASSERT(test::farthest_sample(cleaned, raw) <= bound);
}

RC_GTEST_PROP(LineMapProperty, gives_the_same_bits_again, ()) {
  const auto raw = dirty_plan({0.0, 0.0});
  const LineMap one = LineMap::build(raw);
  const LineMap other = LineMap::build(raw);
  RC_ASSERT(one.walls().size() == other.walls().size());
  for (std::size_t i = 0; i < one.walls().size(); ++i) {
    RC_ASSERT(one.walls()[i].segment.a == other.walls()[i].segment.a);
    RC_ASSERT(one.walls()[i].segment.b == other.walls()[i].segment.b);
  }
}

// Clean walls from a lattice of pitch 1, of which a few run across everything.
std::vector<Segment> uneven_plan() {
  const auto seed = *rc::gen::arbitrary<std::uint64_t>();
  const auto count = *rc::gen::inRange(0, 400);
  std::mt19937_64 random(seed);
  std::normal_distribution<double> cluster(0.0, 30.0);
  std::uniform_real_distribution<double> length(0.05, 0.9);
  std::vector<Segment> raw;
  for (int i = 0; i < count; ++i) {
    const Vector2d start = test::drawn<2>([&] { return std::round(cluster(random)); });
    const double size = i % 37 == 0 ? 500.0 * length(random) : length(random);
    raw.push_back({start, start + unit_vector(cluster(random)) * size});
  }
  if (seed % 3 == 0) raw.push_back({{-1e8, 0.5}, {1e8, 0.5}});  // a line to nowhere
  return raw;
}

RC_GTEST_PROP(LineMapProperty, near_is_what_brute_force_finds, ()) {
  const LineMap map = LineMap::build(uneven_plan());
  for (int query = 0; query < 20; ++query) {
    const Vector2d center(*rc::gen::inRange(-800, 800) * 0.1, *rc::gen::inRange(-800, 800) * 0.1);
    // No radius is a distance between the lattices: rounding would decide.
    const double radius = *rc::gen::inRange(0, 600) * 0.1 + 0.037;
    std::vector<int> expected;
    for (std::size_t i = 0; i < map.walls().size(); ++i) {
      if (distance(map.walls()[i].segment, center) <= radius) {
        expected.push_back(static_cast<int>(i));
      }
    }
    std::vector<int> found;
    map.near(center, radius, found);
    RC_ASSERT(found == expected);
  }
}

}  // namespace
}  // namespace adit
