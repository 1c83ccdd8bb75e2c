#include <algorithm>

#include "adit/simulation/clutter.hpp"
#include "adit/simulation/machine_ahead.hpp"
#include "adit/simulation/ramps_on_way.hpp"
#include "adit/simulation/wall_clutter.hpp"
#include "parts.hpp"

namespace adit {
namespace {

/// Pieces that stand free, five boxes to three people.
int pieces(Clutter clutter) {
  switch (clutter) {
    case Clutter::none:
    case Clutter::leaning:
      return 0;
    case Clutter::five:
    case Clutter::walkers:
    case Clutter::machine_ahead:
      return 5;
    case Clutter::eight:
      return 8;
    case Clutter::twelve:
      return 12;
    case Clutter::twenty:
      return 20;
  }
  return 0;
}

void add_to(World& world, Clutter clutter, std::uint64_t seed) {
  add_clutter(world, clutter_of(pieces(clutter)), seed);
  WallClutterOptions at_walls;
  if (clutter == Clutter::leaning) at_walls.against = at_walls.piercing = 10;
  if (clutter == Clutter::walkers) at_walls.groups = 2;
  add_wall_clutter(world, at_walls, seed);
}

/// Clutter beside a way: farther walls are in nobody's way.
void add_beside(const std::vector<Pose2>& way, Clutter clutter, std::uint64_t seed, World& mine) {
  constexpr double kNearby = 30.0;  // m
  if (way.empty()) return;
  World near;
  near.path = way;
  near.clutter = mine.clutter;
  near.people = mine.people;
  for (const Segment& wall : mine.walls) {
    const bool is_near = std::any_of(way.begin(), way.end(), [&](const Pose2& pose) {
      return distance(wall, pose.translation()) < kNearby;
    });
    if (is_near) near.walls.push_back(wall);
  }
  add_to(near, clutter, seed);
  mine.clutter = std::move(near.clutter);
  mine.people = std::move(near.people);
}

void add_machine(Scene& scene) { add_machine_ahead(scene.world, scene.timed_path(), {}); }

void add_ramps(std::uint64_t seed, Scene& scene) {
  constexpr int kRamps = 3;
  scene.world.path = scene.path;
  lay_ramps(scene.world, kRamps, seed);
}

}  // namespace

void add_things(const Cell& cell, std::uint64_t seed, Scene& scene) {
  add_beside(scene.path, cell.clutter, seed, scene.world);
  add_beside(scene.after, cell.clutter, seed + 1, scene.world);
  if (cell.clutter == Clutter::machine_ahead) add_machine(scene);
  if (cell.fault == ScannerFault::ramps) add_ramps(seed, scene);
}

}  // namespace adit
