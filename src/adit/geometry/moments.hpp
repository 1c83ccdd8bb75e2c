#pragma once

#include <algorithm>

#include "adit/geometry/pose2.hpp"

namespace adit {

/// Sums over a set of points, from which a line is fitted in O(1). They add and subtract, so a
/// sliding window, or any stretch of a list by its prefix sums, costs the same as one point.
struct Moments {
  double n = 0.0;
  double x = 0.0, y = 0.0;
  double xx = 0.0, xy = 0.0, yy = 0.0;

  void add(double px, double py) {
    n += 1.0;
    x += px;
    y += py;
    xx += px * px;
    xy += px * py;
    yy += py * py;
  }
};

inline Moments operator+(const Moments& a, const Moments& b) {
  return {a.n + b.n, a.x + b.x, a.y + b.y, a.xx + b.xx, a.xy + b.xy, a.yy + b.yy};
}
inline Moments operator-(const Moments& a, const Moments& b) {
  return {a.n - b.n, a.x - b.x, a.y - b.y, a.xx - b.xx, a.xy - b.xy, a.yy - b.yy};
}

/// The total-least-squares line of a set of points.
struct LineFit {
  Vector2d centroid = Vector2d::Zero();
  Vector2d direction = Vector2d::UnitX();  ///< unit, sign arbitrary
  double squared_error = 0.0;              ///< sum of squared perpendicular distances (m²)
};

/// Orthogonal regression from the moments of at least two points.
inline LineFit fit_line(const Moments& m) {
  const double mx = m.x / m.n;
  const double my = m.y / m.n;
  const double a = m.xx - m.x * mx;
  const double b = m.xy - m.x * my;
  const double c = m.yy - m.y * my;
  const double half_angle = 0.5 * std::atan2(2.0 * b, a - c);
  const double spread = std::sqrt((a - c) * (a - c) + 4.0 * b * b);
  return {{mx, my}, unit_vector(half_angle), std::max(0.0, 0.5 * (a + c - spread))};
}

}  // namespace adit
