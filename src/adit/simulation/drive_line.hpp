#pragma once

#include <vector>

#include "adit/simulation/drive_map.hpp"

namespace adit {

/// The line with rounded corners and points no more than a step apart, each piece as clear of walls
/// as the map asks. A line whose pieces are clear is expected; its ends stay.
std::vector<Vector2d> smoothed(const DriveMap& map, const std::vector<Vector2d>& line,
                               double step_m);

}  // namespace adit
