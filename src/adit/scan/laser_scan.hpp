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
///
/// Where beams are not evenly spaced, as after deskewing, `bearings` has the exact bearing of each,
/// not wrapped; first bearing and step then say where the first beam points and how far the beams
/// are apart on average.
struct LaserScan {
  double stamp = 0.0;  ///< s
  double first_bearing = 0.0;
  double bearing_step = 0.0;
  double max_range = 0.0;    ///< m
  int scanner = 0;           ///< which of the machine's scanners
  Pose2 vehicle_from_laser;  ///< where the scanner is mounted
  std::vector<double> ranges;
  std::vector<double> bearings;  ///< rad; empty for evenly spaced beams

  double bearing(std::size_t beam) const {
    return bearings.empty() ? first_bearing + static_cast<double>(beam) * bearing_step
                            : bearings[beam];
  }
  bool has_return(std::size_t beam) const {
    return ranges[beam] > 0.0 && ranges[beam] < max_range;  // false for not-a-number
  }
  /// Whether the beams go all the way round, within half a step. The last may repeat the first.
  bool is_full_circle() const {
    return std::abs(bearing_step) * (static_cast<double>(ranges.size()) + 0.5) > kTwoPi;
  }
  /// The beams of one turn, from the first: those that repeat it are not counted.
  std::size_t beams_of_one_turn() const {
    if (!bearings.empty()) return bearings_of_one_turn();
    const double turn = kTwoPi / std::abs(bearing_step) + 0.5;
    return static_cast<double>(ranges.size()) > turn ? static_cast<std::size_t>(turn)
                                                     : ranges.size();
  }

 private:
  std::size_t bearings_of_one_turn() const {
    const double turn = kTwoPi - 0.5 * std::abs(bearing_step);
    std::size_t beams = bearings.size();
    while (beams > 1 && std::abs(bearings[beams - 1] - bearings.front()) >= turn) --beams;
    return beams;
  }
};

}  // namespace adit
