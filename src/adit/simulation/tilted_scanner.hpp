#pragma once

#include <span>

#include "adit/simulation/scanner.hpp"

namespace adit {

/// How far a scanner's plane is from level (rad): pitch about y (nose down is above zero), then
/// roll about x (left side up is above zero), as in REP-103.
struct Tilt {
  double pitch_rad = 0.0;
  double roll_rad = 0.0;
};

/// Where roof and floor are from the scanner (m); its beams end there when they lead up or down far
/// enough.
struct RoofAndFloor {
  double roof_above_m = 1.2;
  double floor_below_m = 1.0;

  template <class Self, class Field>
  static void visit(Self& self, Field&& field) {
    field("roof_above_m", self.roof_above_m, "height of the roof above the scanner (m)");
    field("floor_below_m", self.floor_below_m, "depth of the floor below the scanner (m)");
  }
};

/// The direction of a beam of a tilted scanner in level axes: unit, z up.
Vector3d tilted_direction(double bearing, const Tilt& tilt);

/// As `simulate_scan`, with a scanner that is not level between a level roof and a level floor.
/// Walls and clutter reach from floor to roof.
LaserScan simulate_tilted_scan(const RayCaster& fixed, const Pose2& map_from_vehicle,
                               const ScannerSpec& spec, const Tilt& tilt,
                               const RoofAndFloor& heights, Random& random,
                               std::span<const Segment> moving = {});

}  // namespace adit
