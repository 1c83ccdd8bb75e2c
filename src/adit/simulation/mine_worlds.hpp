#pragma once

#include <cstdint>

#include "adit/simulation/wall_shape.hpp"
#include "adit/simulation/world.hpp"

namespace adit {

/// A room-and-pillar panel.
struct PanelOptions {
  int rows = 3;
  int columns = 4;
  double entry_width_m = 6.0;
  double pillar_length_m = 14.0;
  double pillar_width_m = 14.0;
  double offset_m = 0.0;
  double variation_m = 0.5;
  double path_step_m = 1.6;
  RoughnessOptions walls;

  template <class Self, class Field>
  static void visit(Self& self, Field&& field) {
    field("rows", self.rows, "rows of pillars");
    field("columns", self.columns, "columns of pillars");
    field("entry_width_m", self.entry_width_m, "width of entries and crosscuts (m)");
    field("pillar_length_m", self.pillar_length_m, "length of a pillar along the entries, x (m)");
    field("pillar_width_m", self.pillar_width_m, "width of a pillar, y (m)");
    field("offset_m", self.offset_m, "shift of every second row of pillars along the entries (m)");
    field("variation_m", self.variation_m,
          "how far the sides of the planned pillars lie from the regular grid at most (m)");
    field("path_step_m", self.path_step_m, "distance between the poses of the drive (m)");
    RoughnessOptions::visit(self.walls, field);
  }
};

/// A hard-rock drift: legs that bend, and short side cuts.
struct DriftOptions {
  int legs = 8;
  double leg_min_m = 20.0;
  double leg_max_m = 32.0;
  double bend_max_rad = 0.6;
  double width_m = 5.0;
  double side_cut_depth_m = 6.0;
  double side_cut_width_m = 4.0;
  double path_step_m = 1.6;
  RoughnessOptions walls{.rms_m = 0.12,
                         .correlation_m = 1.2,
                         .wave_rms_m = 0.15,
                         .wave_correlation_m = 5.0,
                         .rib_depth_m = 0.25,
                         .rib_spacing_m = 3.0,
                         .corner_radius_m = 1.0,
                         .point_spacing_m = 0.25};

  template <class Self, class Field>
  static void visit(Self& self, Field&& field) {
    field("legs", self.legs, "straight legs of the drift");
    field("leg_min_m", self.leg_min_m, "shortest leg (m)");
    field("leg_max_m", self.leg_max_m, "longest leg (m)");
    field("bend_max_rad", self.bend_max_rad, "largest turn between two legs (rad)");
    field("width_m", self.width_m, "width of the drift (m)");
    field("side_cut_depth_m", self.side_cut_depth_m, "depth of the cuts in its sides (m)");
    field("side_cut_width_m", self.side_cut_width_m, "width of the cuts in its sides (m)");
    field("path_step_m", self.path_step_m, "distance between the poses of the drive (m)");
    RoughnessOptions::visit(self.walls, field);
  }
};

/// A panel whose plan has straight ribs and whose walls have rough ones; its lower left corner is
/// the origin. The same options and seed give the same world.
World panel(const PanelOptions& options, std::uint64_t seed);

/// A drift that begins at the origin and works its way along +x; plan straight, walls rough.
World drift(const DriftOptions& options, std::uint64_t seed);

}  // namespace adit
