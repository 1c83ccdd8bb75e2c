#include <map>
#include <utility>

#include "parts.hpp"

namespace adit {
namespace {

constexpr std::uint64_t kEnds = 43;  // stream of the seed

/// Walls whose ends are elsewhere than in the plan; those that met still do.
std::vector<Segment> with_moved_ends(std::vector<Segment> walls, double sigma, Random& random) {
  std::map<std::pair<double, double>, Vector2d> moved;
  for (Segment& wall : walls) {
    for (Vector2d* end : {&wall.a, &wall.b}) {
      const auto [known, is_new] = moved.try_emplace({end->x(), end->y()});
      if (is_new) known->second = *end + sigma * Vector2d(random.normal(), random.normal());
      *end = known->second;
    }
  }
  return walls;
}

}  // namespace

bool apply_plan_error(const Cell& cell, std::uint64_t seed, Scene& scene) {
  switch (cell.plan) {
    case PlanError::none:
    case PlanError::rough:
      return true;
    case PlanError::ends_off: {
      Random random(seed, kEnds);
      scene.world.walls = with_moved_ends(std::move(scene.world.walls), cell.bend_m, random);
      return true;
    }
    default:
      return false;
  }
}

}  // namespace adit
