#pragma once

namespace adit {

/// Where in a plan a scanner may stand, and how finely that is laid out.
struct PlaceIndexOptions {
  double pitch_m = 0.75;
  double finest_pitch_m = 0.35;
  double enough_places = 2.0e4;
  double most_places = 2.5e6;
  double coarsest_pitch_m = 2.0;
  double max_range_m = 80.0;
  double least_clearance_m = 0.3;
  double least_in_sight = 0.5;

  template <class Self, class Field>
  static void visit(Self& self, Field&& field) {
    field("pitch_m", self.pitch_m, "places of the index lie so far apart (m)");
    field("finest_pitch_m", self.finest_pitch_m,
          "in a small plan they lie as near as this (m) ...");
    field("enough_places", self.enough_places, "... while that makes no more of them than this");
    field("most_places", self.most_places,
          "they lie farther apart where the plan would hold more of them than this ...");
    field("coarsest_pitch_m", self.coarsest_pitch_m,
          "... and where they would have to lie farther apart than this, there are none: corners "
          "alone are looked for (m)");
    field("max_range_m", self.max_range_m, "a place's walls are looked for as far as this (m)");
    field("least_clearance_m", self.least_clearance_m,
          "no scanner stands nearer to a wall than this (m)");
    field("least_in_sight", self.least_in_sight,
          "a place that sees walls in less than this share of all directions is outside the mine");
  }
};

}  // namespace adit
