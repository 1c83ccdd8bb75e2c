#pragma once

#include <cmath>

#include "adit/geometry/pose2.hpp"

namespace adit {

/// A bearing as one number that grows counter-clockwise without trigonometry: -2 at bearing -pi,
/// 0 on the x axis, 2 at bearing pi. It measures along the diamond |x| + |y| = 1, so it orders
/// directions like the bearing does, to the last bits, and equal directions of small whole numbers
/// get equal keys.
inline double bearing_key(const Vector2d& v) {
  return std::copysign(1.0 - v.x() / (std::abs(v.x()) + std::abs(v.y())), v.y());
}

/// The direction of a key, on the diamond |x| + |y| = 1 (not of unit length).
inline Vector2d key_direction(double key) {
  const double x = 1.0 - std::abs(key);
  return {x, std::copysign(1.0 - std::abs(x), key)};
}

}  // namespace adit
