#include "plan_changes.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "adit/simulation/random.hpp"
#include "adit/simulation/ray_caster.hpp"

namespace adit {
namespace {

// Streams of the seed.
constexpr std::uint64_t kWallMoved = 23;
constexpr std::uint64_t kPillar = 24;

using Segments = std::vector<Segment>;

/// Whether some pose of the way sees the middle of the wall from near, with nothing of the plan
/// between.
bool is_seen(const Segments& plan, const Segment& wall, const std::vector<Pose2>& path) {
  constexpr double kNear = 12.0;  // m
  const Vector2d middle = 0.5 * (wall.a + wall.b);
  return std::any_of(path.begin(), path.end(), [&](const Pose2& pose) {
    const Vector2d sight = middle - pose.translation();
    const double range = sight.norm();
    return range < kNear && cast_ray(plan, pose.translation(), sight / range) > range - 1e-6;
  });
}

/// The wall displaced, with the pieces that join it to its neighbours again.
Segments displaced(const Segment& wall, const Vector2d& by) {
  return {{wall.a, wall.a + by}, {wall.a + by, wall.b + by}, {wall.b + by, wall.b}};
}

bool bars_the_way(const Segments& walls, const std::vector<Pose2>& path) {
  constexpr double kClearance = 0.8;  // m
  return std::any_of(walls.begin(), walls.end(), [&](const Segment& wall) {
    return std::any_of(path.begin(), path.end(), [&](const Pose2& pose) {
      return distance(wall, pose.translation()) < kClearance;
    });
  });
}

/// Consecutive segments of a plan: [first, last).
struct Part {
  std::size_t first = 0;
  std::size_t last = 0;
  bool is_loop = false;
};

/// The closed outlines of a plan.
std::vector<Part> loops(const Segments& plan) {
  std::vector<Part> found;
  std::size_t first = 0;
  for (std::size_t i = 0; i < plan.size(); ++i) {
    if (plan[i].b != plan[first].a) continue;
    found.push_back({first, i + 1, true});
    first = i + 1;
  }
  return found;
}

/// Columns at a wall: out, along and back, each less than a metre.
std::vector<Part> columns(const Segments& plan) {
  constexpr double kColumn = 1.0;
  std::vector<Part> found;
  for (std::size_t i = 0; i + 2 < plan.size(); ++i) {
    const bool small = plan[i].length() < kColumn && plan[i + 1].length() < kColumn &&
                       plan[i + 2].length() < kColumn;
    const Vector2d out = plan[i].b - plan[i].a;
    const Vector2d back = plan[i + 2].b - plan[i + 2].a;
    if (small && (out + back).norm() < 1e-6) found.push_back({i, i + 3, false});
  }
  return found;
}

/// What may be missing: columns, and the outlines that stand within the largest.
std::vector<Part> removable(const Segments& plan) {
  std::vector<Part> all = loops(plan);
  const auto length = [&](const Part& s) {
    double sum = 0.0;
    for (std::size_t i = s.first; i < s.last; ++i) sum += plan[i].length();
    return sum;
  };
  const auto outer = std::max_element(
      all.begin(), all.end(), [&](const Part& s, const Part& t) { return length(s) < length(t); });
  if (outer != all.end()) all.erase(outer);
  const std::vector<Part> small = columns(plan);
  all.insert(all.end(), small.begin(), small.end());
  return all;
}

/// The segments without the part; a column leaves its wall straight.
Segments without(const Segments& segments, const Part& part) {
  const auto at = [&](std::size_t i) { return segments.begin() + static_cast<std::ptrdiff_t>(i); };
  Segments rest(segments.begin(), at(part.first));
  if (!part.is_loop) rest.push_back({segments[part.first].a, segments[part.last - 1].b});
  rest.insert(rest.end(), at(part.last), segments.end());
  return rest;
}

/// Rough walls without those that stand for a planned outline.
Segments without_walls_of(const Segments& walls, const Segments& planned) {
  constexpr double kRoughness = 1.2;  // m; walls of the next outline are an opening away
  Segments rest;
  for (const Segment& wall : walls) {
    const Vector2d middle = 0.5 * (wall.a + wall.b);
    const bool of_it = is_open(planned, middle) ||
                       std::any_of(planned.begin(), planned.end(), [&](const Segment& s) {
                         return distance(s, middle) < kRoughness;
                       });
    if (!of_it) rest.push_back(wall);
  }
  return rest;
}

}  // namespace

bool is_open(std::span<const Segment> plan, const Vector2d& point) {
  int crossed = 0;  // by a ray along +x
  for (const Segment& s : plan) {
    if ((s.a.y() > point.y()) == (s.b.y() > point.y())) continue;
    const double fraction = (point.y() - s.a.y()) / (s.b.y() - s.a.y());
    crossed += s.a.x() + fraction * (s.b.x() - s.a.x()) > point.x() ? 1 : 0;
  }
  return crossed % 2 == 1;
}

bool move_wall(World& world, std::uint64_t seed) {
  constexpr double kShift = 1.0;     // m
  constexpr double kShortest = 1.0;  // m: less is no wall
  constexpr int kTries = 200;
  Random random(seed, kWallMoved);
  const Segments right = world.plan;
  for (int i = 0; i < kTries; ++i) {
    const int choice = random.below(static_cast<int>(right.size()));
    const Segment& wall = right[static_cast<std::size_t>(choice)];
    const double side = random.chance(0.5) ? kShift : -kShift;
    if (wall.length() < kShortest || !is_seen(right, wall, world.path)) continue;
    const Segments moved = displaced(wall, side * perpendicular((wall.b - wall.a).normalized()));
    if (bars_the_way(moved, world.path)) continue;
    world.plan.erase(world.plan.begin() + choice);
    world.plan.insert(world.plan.end(), moved.begin(), moved.end());
    return true;
  }
  return false;
}

bool remove_pillar(World& world, std::uint64_t seed) {
  Random random(seed, kPillar);
  const Segments planned = world.plan;
  const std::vector<Part> choices = removable(planned);
  if (choices.empty()) return false;
  const auto choice = static_cast<std::size_t>(random.below(static_cast<int>(choices.size())));
  const Part& part = choices[choice];
  const Segments rest = without(planned, part);
  if (seed % 2 == 0) {
    world.plan = rest;
    return true;
  }
  if (part.is_loop) {
    const auto at = [&](std::size_t i) { return planned.begin() + static_cast<std::ptrdiff_t>(i); };
    world.walls = without_walls_of(world.walls, {at(part.first), at(part.last)});
  } else {
    world.walls = rest;  // only plans that are exact have columns
  }
  return true;
}

}  // namespace adit
