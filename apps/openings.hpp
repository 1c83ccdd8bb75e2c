#pragma once

#include <optional>
#include <vector>

#include "adit/map/line_map.hpp"
#include "adit/places/place_index.hpp"

namespace adit {

/// Which places of a plan a machine may be at.
struct OpeningsOptions {
  double places = 500.0;
  double least_pitch_m = 0.5;
  double least_clearance_m = 0.8;
  double least_inside = 0.05;
  double least_part = 0.05;

  template <class Self, class Field>
  static void visit(Self& self, Field&& field) {
    field("places", self.places, "so many places are looked at, if no pitch is given");
    field("least_pitch_m", self.least_pitch_m, "but none nearer to each other than this (m)");
    field("least_clearance_m", self.least_clearance_m, "a machine is this far from walls (m)");
    field("least_inside", self.least_inside,
          "where a smaller part of all places than this lies within outlines, the plan is not one "
          "of outlines");
    field("least_part", self.least_part,
          "what is smaller than this part of the largest opening is rock: a pillar's inside");
  }
};

/// Places on a square lattice along the openings of a plan, row by row, and its pitch (m).
struct Openings {
  std::vector<Vector2d> places;
  double pitch_m = 0.0;
};

/// Openings lie within the mine's outline and outside of its pillars', and are not small. One place
/// of the index is chosen in each square of the lattice, near its middle; none near walls.
Openings openings_of(const LineMap& map, const PlaceIndex& index, std::optional<double> pitch_m,
                     const OpeningsOptions& options);

}  // namespace adit
