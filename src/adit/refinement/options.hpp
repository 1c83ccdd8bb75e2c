#pragma once

#include "adit/geometry/angle.hpp"
#include "adit/refinement/beam_priors.hpp"

namespace adit {

/// How the beams of a scan are weighed, and when the fit is done.
struct RefinementOptions {
  BeamPriors priors;  ///< a table of their own: searches share them
  double max_incidence_rad = radians(89.0);
  int max_iterations = 12;
  double step_tolerance = 1.0;
  double max_step_m = 0.7;
  double max_step_rad = 0.15;
  double station_spacing_m = 0.1;
  double same_place_m = 0.01;
  bool looks_beyond = true;
  double neighbour_reach_m = 0.3;
  double corner_reach_ratio = 5.0;
  double corner_sigma_ratio = 12.0;

  template <class Self, class Field>
  static void visit(Self& self, Field&& field) {
    field("max_incidence_rad", self.max_incidence_rad,
          "beams that meet a wall flatter than this (rad from its normal) are not used");
    field("max_iterations", self.max_iterations, "most Gauss-Newton steps");
    field("step_tolerance", self.step_tolerance,
          "a step smaller than this part of its own sigma is the last; one up to three times as "
          "long, below 2 cm and 0.2 degrees, too: it is taken as linear");
    field("max_step_m", self.max_step_m, "a longer step is shortened to this (m)");
    field("max_step_rad", self.max_step_rad, "a step that turns more is shortened to this (rad)");
    field("station_spacing_m", self.station_spacing_m,
          "on the move, the map is looked at anew after so much way of the scanner (m)");
    field("looks_beyond", self.looks_beyond,
          "a beam that went through a wall is held against the one that it ends at");
    field("same_place_m", self.same_place_m,
          "what the map shows is worked out anew after a step of so much (m): but for a beam at an "
          "edge, all is the same from nearer by");
    field(
        "neighbour_reach_m", self.neighbour_reach_m,
        "a wall no farther than this from the one in the beam's way may be what the beam met (m)");
    field("corner_reach_ratio", self.corner_reach_ratio,
          "nearer to a corner than this times the map's error, the wall may be rounded off");
    field(
        "corner_sigma_ratio", self.corner_sigma_ratio,
        "sigma of a wall's place at a corner, in the map's errors; it falls to none at the reach");
  }
};

}  // namespace adit
