#pragma once

#include <algorithm>
#include <limits>

#include "adit/geometry/segment.hpp"

namespace adit {

/// An axis-aligned rectangle (m, map frame); empty until something was put into it.
struct Box {
  Vector2d min = Vector2d::Constant(std::numeric_limits<double>::infinity());
  Vector2d max = Vector2d::Constant(-std::numeric_limits<double>::infinity());

  bool is_empty() const { return !(min.x() <= max.x() && min.y() <= max.y()); }
  Vector2d center() const { return 0.5 * (min + max); }
  Vector2d size() const { return is_empty() ? Vector2d(0.0, 0.0) : Vector2d(max - min); }

  void extend(const Vector2d& point) {
    min = min.cwiseMin(point);
    max = max.cwiseMax(point);
  }
  void extend(const Box& other) {
    min = min.cwiseMin(other.min);
    max = max.cwiseMax(other.max);
  }

  /// The box with `margin` metres more on every side.
  Box padded(double margin) const {
    const Vector2d by = Vector2d::Constant(margin);
    return {min - by, max + by};
  }
  /// True when the two have a point in common, borders included.
  bool overlaps(const Box& other) const {
    return min.x() <= other.max.x() && other.min.x() <= max.x() && min.y() <= other.max.y() &&
           other.min.y() <= max.y();
  }
  /// Squared distance to the nearest point of the box (m2), zero inside.
  double squared_distance(const Vector2d& point) const {
    const double dx = std::max({min.x() - point.x(), 0.0, point.x() - max.x()});
    const double dy = std::max({min.y() - point.y(), 0.0, point.y() - max.y()});
    return dx * dx + dy * dy;
  }
};

/// The smallest box around a segment.
inline Box box_of(const Segment& s) { return {s.a.cwiseMin(s.b), s.a.cwiseMax(s.b)}; }

}  // namespace adit
