#pragma once

#include <algorithm>
#include <cmath>
#include <span>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "adit/map/line_map.hpp"

namespace adit::test {

/// Which side of the line through `s` the point lies on, by more than `tolerance` metres: +1, -1,
/// or 0.
inline int side_of(const Segment& s, const Vector2d& point, double tolerance) {
  const double offset = cross(s.b - s.a, point - s.a) / s.length();
  return offset > tolerance ? 1 : offset < -tolerance ? -1 : 0;
}

/// True when the walls meet anywhere but at a vertex of both, judged at `tolerance` metres.
inline bool meet_badly(const Wall& one, const Wall& other, double tolerance) {
  if (!box_of(one.segment).padded(tolerance).overlaps(box_of(other.segment))) return false;
  const auto touches = [&](const Wall& wall, int vertex, const Vector2d& at) {
    if (wall.vertex_a == vertex || wall.vertex_b == vertex) return false;
    return distance(wall.segment, at) <= tolerance;
  };
  if (touches(one, other.vertex_a, other.segment.a) ||
      touches(one, other.vertex_b, other.segment.b) ||
      touches(other, one.vertex_a, one.segment.a) || touches(other, one.vertex_b, one.segment.b)) {
    return true;
  }
  // Nothing of either lies on the other now, so that a crossing is a strict one.
  return side_of(one.segment, other.segment.a, tolerance) *
                 side_of(one.segment, other.segment.b, tolerance) <
             0 &&
         side_of(other.segment, one.segment.a, tolerance) *
                 side_of(other.segment, one.segment.b, tolerance) <
             0;
}

/// What a cleaned map must not be, found by comparing every wall with every other; empty if sound.
inline std::string faults_of(const LineMap& map, double tolerance = 1e-6) {
  std::ostringstream faults;
  faults.precision(12);
  const auto walls = map.walls();
  const auto show = [](const Wall& w) {
    std::ostringstream text;
    text.precision(12);
    text << w.vertex_a << "(" << w.segment.a.transpose() << ") - " << w.vertex_b << "("
         << w.segment.b.transpose() << ")";
    return text.str();
  };
  for (std::size_t i = 0; i < walls.size(); ++i) {
    const Wall& wall = walls[i];
    if (wall.vertex_a == wall.vertex_b || !(wall.segment.length() > 0.0)) {
      faults << "zero length: " << show(wall) << "\n";
    }
    for (const auto& [vertex, at] : {std::pair(wall.vertex_a, wall.segment.a),  //
                                     std::pair(wall.vertex_b, wall.segment.b)}) {
      if (map.vertices()[static_cast<std::size_t>(vertex)] != at) faults << "end off its vertex\n";
      const auto there = map.walls_at(vertex);
      if (std::count(there.begin(), there.end(), static_cast<int>(i)) != 1) {
        faults << "wall unknown to its vertex\n";
      }
    }
    for (std::size_t j = 0; j < i; ++j) {
      const auto ends = std::minmax(wall.vertex_a, wall.vertex_b);
      if (ends == std::minmax(walls[j].vertex_a, walls[j].vertex_b)) {
        faults << "equal: " << show(wall) << " and " << show(walls[j]) << "\n";
      } else if (meet_badly(wall, walls[j], tolerance)) {
        faults << "meet: " << show(wall) << " and " << show(walls[j]) << "\n";
      }
    }
  }
  std::size_t ends = 0;
  for (int v = 0; v < static_cast<int>(map.vertices().size()); ++v) {
    if (map.walls_at(v).empty()) faults << "vertex of no wall\n";
    ends += map.walls_at(v).size();
  }
  if (ends != 2 * walls.size()) faults << "walls and vertices disagree\n";
  return faults.str();
}

/// The walls as plain segments.
inline std::vector<Segment> segments_of(const LineMap& map) {
  std::vector<Segment> segments;
  for (const Wall& wall : map.walls()) segments.push_back(wall.segment);
  return segments;
}

/// How far the farthest of points sampled along every `stride`-th of `from` is from the nearest
/// segment in `to` (m).
inline double farthest_sample(std::span<const Segment> from, std::span<const Segment> to,
                              std::size_t stride = 1) {
  constexpr int samples = 7;
  double farthest = 0.0;
  for (std::size_t i = 0; i < from.size(); i += stride) {
    const Segment& s = from[i];
    for (int k = 0; k <= samples; ++k) {
      const Vector2d point = s.a + (s.b - s.a) * k / samples;
      double nearest = std::numeric_limits<double>::infinity();
      for (const Segment& t : to) nearest = std::min(nearest, distance(t, point));
      farthest = std::max(farthest, nearest);
    }
  }
  return farthest;
}

}  // namespace adit::test
