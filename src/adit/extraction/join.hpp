#pragma once

#include <optional>

#include "adit/features/features.hpp"

namespace adit {

/// The corner in which two neighbouring lines meet, `before` counter-clockwise before `after`, with
/// its covariance; absent where the wall turns less than `min_turn` (rad).
std::optional<Corner> intersect(const Line& before, const Line& after, double min_turn);

/// The occluding corner at one end of a line: the edge lies on the line, at bearing `edge` (unit
/// vector) known to `bearing_sigma` (rad). `arm` is 0 when the line comes before the corner
/// counter-clockwise, 1 when after.
Corner occluding_corner(const Line& line, int arm, const Vector2d& edge, double bearing_sigma);

}  // namespace adit
