#pragma once

#include <algorithm>
#include <cmath>

#include "adit/geometry/pose2.hpp"

namespace adit {

/// A straight piece of wall from a to b (m).
struct Segment {
  Vector2d a = Vector2d::Zero();
  Vector2d b = Vector2d::Zero();

  double length() const { return (b - a).norm(); }
  bool is_finite() const { return a.allFinite() && b.allFinite(); }
};

/// The point of the segment nearest to `p`; a zero-length segment is its point.
inline Vector2d nearest_point(const Segment& s, const Vector2d& p) {
  const Vector2d along = s.b - s.a;
  const double squared = along.squaredNorm();
  if (squared == 0.0) return s.a;
  return s.a + along * std::clamp((p - s.a).dot(along) / squared, 0.0, 1.0);
}

/// Distance from a point to the segment (m).
inline double distance(const Segment& s, const Vector2d& p) {
  return (nearest_point(s, p) - p).norm();
}

}  // namespace adit
