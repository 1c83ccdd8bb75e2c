#pragma once

#include "adit/simulation/world.hpp"

namespace adit {

/// Another machine that drives ahead of the vehicle on the same way.
struct MachineAheadOptions {
  double gap_m = 6.0;
  double length_m = 2.5;
  double width_m = 1.8;

  template <class Self, class Field>
  static void visit(Self& self, Field&& field) {
    field("gap_m", self.gap_m,
          "from the vehicle's origin to the machine's middle, along the way (m)");
    field("length_m", self.length_m, "length of the machine (m)");
    field("width_m", self.width_m, "width of the machine (m)");
  }
};

/// Lets a machine drive the gap ahead of a vehicle with this drive. It turns off at the end of the
/// way: from then on it is gone, and so it is while the way leads back to within 0.6 gaps of the
/// vehicle. Returns for how long it is there (s).
double add_machine_ahead(World& world, const TimedPath& vehicle,
                         const MachineAheadOptions& options);

}  // namespace adit
