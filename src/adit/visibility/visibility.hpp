#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "adit/geometry/pose2.hpp"
#include "adit/map/line_map.hpp"
#include "adit/visibility/envelope.hpp"

namespace adit {

/// What makes the end of a visible interval.
enum class Boundary {
  vertex,    ///< the wall's own end (a map vertex): look at the neighbour for what lies beside it
  occluded,  ///< a nearer wall's end begins or stops hiding this wall here
  range_limit,  ///< the wall goes on beyond the maximum range
};

/// A stretch of one wall that the observer sees, counter-clockwise from `begin` to `end`.
struct VisibleInterval {
  int wall = -1;                      ///< index in the map
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
/// edge-on and subtend nothing), an observer on a wall (that wall is seen edge-on as well), an
/// empty map. Two intervals share a bearing only at their ends. A wall that spans the bearing pi is
/// not cut there. Walls whose line passes within a nanometre of the observer (more where map
/// coordinates are too large for that) count as edge-on; intervals narrower than about 1e-12 rad
/// are left out.
class Visibility {
 public:
  /// Computes the intervals seen from `observer` up to `max_range` metres. An observer or a range
  /// that is not a number, or a range that is not positive, sees nothing.
  void sweep(const LineMap& map, const Vector2d& observer, double max_range);

  /// In counter-clockwise order of their begin, from bearing -pi (an interval that spans the
  /// bearing pi comes last).
  std::span<const VisibleInterval> intervals() const { return intervals_; }

  /// Range to the first wall along each of the bearings first + i * step (rad, map axes), or
  /// infinity. `walls[i]`, if given, becomes the index of the wall hit or -1. One walk over both
  /// lists: O(beams + intervals). Where two walls meet a bearing to the last bits, the nearer
  /// counts.
  void ranges(double first_bearing, double bearing_step, std::span<double> out,
              std::span<int> walls = {}) const;

  /// The index of the first wall along each of these bearings, or -1, without its range. Where two
  /// walls meet a bearing to the last bits, either counts.
  void walls_along(double first_bearing, double bearing_step, std::span<int> walls) const;

 private:
  struct Ring {
    double inner = 0.0;  // excluded (m); negative for none
    double outer = 0.0;  // included (m)
  };

  void add_rings(const LineMap& map, const Vector2d& observer, double max_range);
  void find_near(const LineMap& map, const Vector2d& observer, double radius);
  void stage_ring(const LineMap& map, const Vector2d& observer, Ring ring, double max_range);
  void collect_intervals();
  template <class Take>
  void deal_out(double first_bearing, double bearing_step, std::size_t beams, Take&& take) const;

  Envelope envelope_;
  std::vector<int> near_;
  std::vector<VisibleInterval> intervals_;
  std::vector<Vector2d> inverse_ranges_;      // of each interval's wall
  std::vector<std::array<double, 2>> turns_;  // bearings of each interval's begin and end (rad)
};

}  // namespace adit
