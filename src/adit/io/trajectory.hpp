#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "adit/geometry/result.hpp"
#include "adit/motion/odometry.hpp"

namespace adit {

/// Reads a trajectory in TUM form, `t x y z qx qy qz qw` a line, `#` comments, in the file's order.
///
/// z is ignored and theta is the yaw of the quaternion, so slightly tilted poses are tolerated.
/// Errors name the line: a row that is not eight finite numbers, a quaternion whose length is not 1
/// within 5 %, no row at all, binary data.
Result<std::vector<StampedPose>> read_trajectory(const std::string& path);

/// The same from text; `file` is the name in errors.
Result<std::vector<StampedPose>> parse_trajectory(std::string_view text,
                                                  const std::string& file = {});

/// Writes TUM form: stamps with six decimals, the rest with nine. Whole or not at all.
Result<void> write_trajectory(std::span<const StampedPose> poses, const std::string& path);

}  // namespace adit
