#pragma once

#include <cstdint>

#include "adit/simulation/world.hpp"

namespace adit {

/// What stands about that no plan shows.
struct ClutterOptions {
  int boxes = 5;
  int people = 3;
  int walkers = 0;
  double box_min_m = 0.5;
  double box_max_m = 1.5;
  double path_clearance_m = 1.2;
  double wall_clearance_m = 0.05;
  double spread_m = 8.0;

  template <class Self, class Field>
  static void visit(Self& self, Field&& field) {
    field("boxes", self.boxes, "boxes, turned at random");
    field("people", self.people, "people who stand still, 0.4 to 0.5 m across");
    field("walkers", self.walkers, "people who pace up and down");
    field("box_min_m", self.box_min_m, "shortest side of a box (m)");
    field("box_max_m", self.box_max_m, "longest side of a box (m)");
    field("path_clearance_m", self.path_clearance_m,
          "nothing stands nearer than this to the vehicle's way (m)");
    field("wall_clearance_m", self.wall_clearance_m, "nor nearer than this to a wall (m)");
    field("spread_m", self.spread_m, "nor further than this from the vehicle's way (m)");
  }
};

/// The usual mix of so many pieces: five boxes to three people.
ClutterOptions clutter_of(int pieces);

/// Puts clutter into the free space beside `world.path`, in sight of it; where a world has no room
/// or no path, less than asked. Returns how many pieces now stand there.
int add_clutter(World& world, const ClutterOptions& options, std::uint64_t seed);

}  // namespace adit
