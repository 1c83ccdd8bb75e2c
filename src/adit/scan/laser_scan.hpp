#pragma once

#include <cmath>
#include <vector>

#include "adit/geometry/pose2.hpp"

namespace adit {

/// One sweep of a planar laser scanner.
///
/// Beam i points at `first_bearing + i * bearing_step` (rad, laser frame, counter-clockwise; a
/// negative step is a scanner that turns clockwise) and measured `ranges[i]` metres. A range that
/// is not finite, not above zero, or at or over `max_range` is "no return".
struct LaserScan {
  double stamp = 0.0;  ///< s
  double first_bearing = 0.0;
  double bearing_step = 0.0;
  double max_range = 0.0;    ///< m
  Pose2 vehicle_from_laser;  ///< where the scanner is mounted
  std::vector<double> ranges;

  double bearing(std::size_t beam) const {
    return first_bearing + static_cast<double>(beam) * bearing_step;
  }
  bool has_return(std::size_t beam) const {
    return ranges[beam] > 0.0 && ranges[beam] < max_range;  // false for not-a-number
  }
  /// Whether the last beam is followed by the first one: a full circle, within half a step.
  bool is_full_circle() const {
    return std::abs(std::abs(bearing_step) * static_cast<double>(ranges.size()) - kTwoPi) <
           0.5 * std::abs(bearing_step);
  }
};

}  // namespace adit
