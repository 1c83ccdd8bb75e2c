#pragma once

#include <string>

#include "adit/geometry/pose2.hpp"
#include "adit/geometry/result.hpp"

namespace adit {

/// Reads `x,y,heading` in metres, metres, degrees, as the command line gives poses.
Result<Pose2> parse_pose(const std::string& text);

}  // namespace adit
