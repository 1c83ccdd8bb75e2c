#include "adit/simulation/ramp.hpp"

#include <cmath>

namespace adit {

std::vector<Segment> cuts_of(const Ramp& ramp, const Vector2d& vehicle) {
  const Vector2d rise = unit_vector(ramp.heading);
  const Vector2d across = 0.5 * ramp.width_m * perpendicular(rise);
  const double at = rise.dot(vehicle - ramp.foot);
  const bool is_in_strip = std::abs(cross(rise, vehicle - ramp.foot)) <= 0.5 * ramp.width_m;
  // Metres along the ramp in which the floor rises to the scanner, or the roof falls to it.
  const double to_floor = ramp.scanner_height_m / std::tan(ramp.slope_rad);
  const double to_roof = (ramp.room_height_m - ramp.scanner_height_m) / std::tan(ramp.slope_rad);
  std::vector<Segment> cuts;
  const auto cut_at = [&](double along) {
    const Vector2d middle = ramp.foot + along * rise;
    cuts.push_back({middle - across, middle + across});
  };
  if (at <= 0.0) {
    if (to_floor < ramp.length_m) cut_at(to_floor);
  } else if (is_in_strip && at < ramp.length_m) {
    cut_at(-to_floor);
    cut_at(ramp.length_m + to_roof);
  } else if (is_in_strip && to_roof < ramp.length_m) {
    cut_at(ramp.length_m - to_roof);
  }
  return cuts;
}

}  // namespace adit
