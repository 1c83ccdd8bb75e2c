#pragma once

#include <span>
#include <vector>

#include "adit/geometry/pose2.hpp"
#include "adit/map/line_map.hpp"

namespace adit {

/// What makes the end of a visible interval.
enum class Boundary {
  vertex,       ///< the wall's own end (a map vertex): look at the neighbour for what lies beside it
  occluded,     ///< a nearer wall's end begins or stops hiding this wall here
  range_limit,  ///< the wall goes on beyond the maximum range
};

/// A stretch of one wall that the observer sees, counter-clockwise from `begin` to `end`.
struct VisibleInterval {
  int wall = -1;  ///< index in the map
  Vector2d begin = Vector2d::Zero();  ///< relative to the observer, map axes (m)
  Vector2d end = Vector2d::Zero();
  Boundary begin_kind = Boundary::vertex;
  Boundary end_kind = Boundary::vertex;
  int begin_vertex = -1;  ///< map vertex where the kind is `vertex`, else -1
  int end_vertex = -1;
};

/// What a position sees: the angular sweep over the walls within range, O(k log k) in the k walls
/// near. Holds its buffers: a second sweep of the same size allocates nothing.
///
/// Exact on degenerate input: shared end points, walls collinear with the observer (they are seen
/// edge-on and subtend nothing), an observer on a wall (that wall is seen edge-on as well), an empty
/// map. Two intervals share a bearing only at their ends. A wall that spans the bearing pi is not cut there.
class Visibility {
 public:
  /// Computes the intervals seen from `observer` up to `max_range` metres.
  void sweep(const LineMap& map, const Vector2d& observer, double max_range);

  /// In counter-clockwise order of their begin, from bearing -pi (an interval that spans the bearing
  /// pi comes last).
  std::span<const VisibleInterval> intervals() const { return intervals_; }

  /// Range to the first wall along each of the bearings first + i * step (rad, map axes), or
  /// infinity. `walls[i]`, if given, becomes the index of the wall hit or -1. One walk over both
  /// lists: O(beams + intervals).
  void ranges(double first_bearing, double bearing_step, std::span<double> out,
              std::span<int> walls = {}) const;

 private:
  std::vector<VisibleInterval> intervals_;
};

}  // namespace adit
