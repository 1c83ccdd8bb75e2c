#include <map>
#include <utility>

#include "adit/simulation/as_built.hpp"
#include "parts.hpp"
#include "plan_changes.hpp"

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

AsBuiltOptions as_built_options(const Cell& cell) {
  constexpr double kShare = 0.05;
  AsBuiltOptions options;
  options.bend_m = cell.bend_m;
  options.rough_m = 0.05;
  switch (cell.plan) {
    case PlanError::missing_added:
      options.missing_ratio = kShare;
      options.added_ratio = kShare;
      return options;
    case PlanError::chains:
      options.chains_ratio = 0.2;
      return options;
    case PlanError::distorted:
      options.distortion = 0.002;
      return options;
    default:
      return options;
  }
}

/// Bends the mine, and the ways through it.
void bend(const Cell& cell, std::uint64_t seed, Scene& scene) {
  const std::size_t before = scene.path.size();
  scene.world.path = scene.path;
  scene.world.path.insert(scene.world.path.end(), scene.after.begin(), scene.after.end());
  scene.world = as_built(std::move(scene.world), as_built_options(cell), seed);
  const auto parted = scene.world.path.begin() + static_cast<std::ptrdiff_t>(before);
  scene.path.assign(scene.world.path.begin(), parted);
  scene.after.assign(parted, scene.world.path.end());
}

/// The estimator gets a plan that no other drive has.
void give_own_plan(Scene& scene) {
  scene.own_map = std::make_shared<const LineMap>(LineMap::build(scene.world.plan));
  scene.own_index = std::make_shared<const PlaceIndex>(PlaceIndex::build(*scene.own_map, {}, 1));
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
    case PlanError::bent:
    case PlanError::missing_added:
    case PlanError::chains:
    case PlanError::distorted:
      bend(cell, seed, scene);
      return true;
    case PlanError::off_plan:
      scene.missing = scene.path[scene.path.size() / 2].translation();
      bend(cell, seed, scene);
      scene.world = off_plan(std::move(scene.world), *scene.missing, kOffPlanRadius);
      give_own_plan(scene);
      return true;
    case PlanError::wall_moved:
    case PlanError::pillar:
      scene.world.path = scene.path;
      if (!(cell.plan == PlanError::pillar ? remove_pillar(scene.world, seed)
                                           : move_wall(scene.world, seed))) {
        return false;
      }
      give_own_plan(scene);
      return true;
  }
  return false;
}

}  // namespace adit
