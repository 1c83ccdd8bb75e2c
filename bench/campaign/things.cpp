#include <algorithm>

#include "adit/simulation/clutter.hpp"
#include "parts.hpp"

namespace adit {
namespace {

ClutterOptions clutter_options(Clutter clutter) {
  switch (clutter) {
    case Clutter::none:
      return clutter_of(0);
    case Clutter::five:
      return clutter_of(5);
    case Clutter::eight:
      return clutter_of(8);
    case Clutter::twelve:
      return clutter_of(12);
    case Clutter::twenty:
    case Clutter::leaning:
      return clutter_of(20);
    case Clutter::walkers:
      return clutter_of(5);
    case Clutter::machine_ahead:
      return clutter_of(5);
  }
  return clutter_of(0);
}

/// Clutter beside a way: farther walls are in nobody's way.
void add_beside(const std::vector<Pose2>& way, const ClutterOptions& options, std::uint64_t seed,
                World& mine) {
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
  add_clutter(near, options, seed);
  mine.clutter = std::move(near.clutter);
  mine.people = std::move(near.people);
}

}  // namespace

void add_things(const Cell& cell, std::uint64_t seed, Scene& scene) {
  const ClutterOptions options = clutter_options(cell.clutter);
  add_beside(scene.path, options, seed, scene.world);
  add_beside(scene.after, options, seed + 1, scene.world);
}

}  // namespace adit
