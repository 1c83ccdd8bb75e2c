#pragma once

#include <vector>

#include "adit/geometry/segment.hpp"

namespace adit {

/// A floor that rises at a steady slope along a strip of the map, with level floor before and
/// after; the roof follows the floor. Metres and radians, map frame.
///
/// The scanner's plane is parallel to the floor under the vehicle. So a beam that is longer than
/// some range meets the floor (of a ramp ahead, or of the level at the foot of the ramp that the
/// vehicle drives down) or the roof (at the top of the ramp that it drives up, or of a ramp that
/// falls away ahead). Distances are horizontal; the pitch changes at once where the slope does.
struct Ramp {
  Vector2d foot = Vector2d::Zero();  ///< the middle of the strip, where it begins to rise
  double heading = 0.0;              ///< the direction of the rise
  double length_m = 20.0;            ///< along the rise, horizontally
  double width_m = 6.0;              ///< of the strip
  double slope_rad = 0.14;           ///< above zero
  double scanner_height_m = 1.0;     ///< over the floor
  double room_height_m = 2.2;        ///< from floor to roof
};

/// Where floor or roof of the ramp's strip cut the scanner's plane of a vehicle at this place:
/// lines across the strip, none to two. A vehicle beside the strip, but before its foot, stands on
/// the level of the foot; beside the ramp itself it has a floor of its own and sees none.
std::vector<Segment> cuts_of(const Ramp& ramp, const Vector2d& vehicle);

}  // namespace adit
