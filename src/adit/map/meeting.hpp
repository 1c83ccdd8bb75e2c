#pragma once

#include <optional>

#include "adit/geometry/segment.hpp"

namespace adit {

/// True when `point` lies beside the segment, strictly between its ends, within `tolerance` (m).
inline bool is_beside(const Segment& s, const Vector2d& point, double tolerance) {
  const Vector2d along = s.b - s.a;
  const Vector2d to_point = point - s.a;
  const double squared = along.squaredNorm();
  const double projected = to_point.dot(along);
  if (projected <= 0.0 || projected >= squared) return false;
  const double area = cross(along, to_point);
  return area * area <= tolerance * tolerance * squared;
}

/// Where two segments cross, inside of both; nothing for segments that only touch or are parallel.
inline std::optional<Vector2d> crossing_of(const Segment& s, const Segment& t) {
  const Vector2d along_s = s.b - s.a;
  const Vector2d along_t = t.b - t.a;
  const Vector2d between = t.a - s.a;
  const double ta = cross(along_s, between);
  const double tb = cross(along_s, t.b - s.a);
  if (!((ta < 0.0 && tb > 0.0) || (ta > 0.0 && tb < 0.0))) return std::nullopt;
  const double sa = cross(along_t, s.a - t.a);
  const double sb = cross(along_t, s.b - t.a);
  if (!((sa < 0.0 && sb > 0.0) || (sa > 0.0 && sb < 0.0))) return std::nullopt;
  return s.a + along_s * (sa / (sa - sb));
}

}  // namespace adit
