#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "adit/simulation/world.hpp"

namespace adit {

/// What stands at walls and hides them, and people who walk along the way.
struct WallClutterOptions {
  int against = 0;
  int piercing = 0;
  int along = 0;
  int rows = 0;
  int groups = 0;
  double box_min_m = 0.5;
  double box_max_m = 1.5;
  double run_min_m = 4.0;
  double run_max_m = 10.0;
  double row_m = 15.0;
  double path_clearance_m = 1.2;
  double spread_m = 8.0;

  template <class Self, class Field>
  static void visit(Self& self, Field&& field) {
    field("against", self.against, "boxes with one side on a wall");
    field("piercing", self.piercing, "boxes, turned at random, through which a wall goes");
    field("along", self.along, "long things along a wall, such as a belt or pipes");
    field("rows", self.rows, "stretches of the way that boxes line on both sides");
    field("groups", self.groups, "groups of three people who walk up and down along the way");
    field("box_min_m", self.box_min_m, "shortest side of a box (m)");
    field("box_max_m", self.box_max_m, "longest side of a box (m)");
    field("run_min_m", self.run_min_m, "shortest of the long things (m)");
    field("run_max_m", self.run_max_m, "longest of them (m)");
    field("row_m", self.row_m, "length of a stretch that is lined (m)");
    field("path_clearance_m", self.path_clearance_m,
          "nothing stands nearer than this to the vehicle's way (m)");
    field("spread_m", self.spread_m, "nor at a wall further than this from it (m)");
  }
};

/// So many pieces of one kind, by its name: `against`, `piercing`, `along`, `rows`, `groups`; or
/// `mixed`: a quarter through walls, a sixteenth along them, the rest against them. Nothing for
/// another name.
std::optional<WallClutterOptions> wall_clutter_named(std::string_view kind, int pieces);

/// Puts it in sight of `world.path`; pieces may stand in each other. Where there is no room or no
/// path it is less than asked. Returns how many pieces (rows, groups) there now are.
int add_wall_clutter(World& world, const WallClutterOptions& options, std::uint64_t seed);

}  // namespace adit
