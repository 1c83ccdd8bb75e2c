#pragma once

#include <span>

#include "adit/refinement/beam_residuals.hpp"
#include "adit/scan/scanner_model.hpp"

namespace adit {

/// When returns off a wall of the map look like that wall, drawn in another place.
struct DisplacementOptions {
  double least_length_m = 1.5;
  double most_m = 2.5;
  double roughness_ratio = 1.5;

  template <class Self, class Field>
  static void visit(Self& self, Field&& field) {
    field("least_length_m", self.least_length_m,
          "a shorter stretch parallel to a wall of the map may be anything that stands about (m)");
    field("most_m", self.most_m, "a stretch farther than this from the wall is another wall (m)");
    field("roughness_ratio", self.roughness_ratio,
          "a stretch that scatters by more than so many sigmas of walls and noise is no wall");
  }
};

/// How far (m) a stretch of returns lies from the wall of the map that it is parallel to, the
/// largest of all; 0 where nothing looks like a wall in the wrong place.
///
/// Either that wall is drawn wrong, or the pose is wrong by this and all others are: the scan alone
/// cannot tell.
double largest_displacement(std::span<const BeamResidual> beams, std::span<const double> on_wall,
                            const ScannerModel& scanner, double map_sigma_m,
                            const DisplacementOptions& options);

}  // namespace adit
