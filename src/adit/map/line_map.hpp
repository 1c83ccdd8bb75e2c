#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "adit/map/spatial_index.hpp"

namespace adit {

/// Tolerances of cleaning a plan.
struct LineMapOptions {
  double snap_m = 0.01;
  double merge_offset_m = 0.002;

  template <class Self, class Field>
  static void visit(Self& self, Field&& field) {
    field("snap_m", self.snap_m,
          "end points nearer than this become one vertex, an end nearer than this to a wall "
          "becomes a "
          "T-junction (m); drawing accuracy of mine plans");
    field("merge_offset_m", self.merge_offset_m,
          "neighbouring pieces whose common vertex lies nearer than this to the joined line become "
          "one (m); a tenth of what the best scanners resolve");
  }
};

/// What cleaning did: counts of segments or vertices.
struct MapReport {
  std::int64_t input = 0;
  std::int64_t not_finite = 0;
  std::int64_t zero_length = 0;
  std::int64_t snapped_ends = 0;
  std::int64_t crossings = 0;
  std::int64_t t_junctions = 0;
  std::int64_t duplicates = 0;
  std::int64_t merged = 0;
  std::int64_t output = 0;
};

/// A cleaned wall: a segment and the vertices at its ends.
struct Wall {
  Segment segment;
  int vertex_a = -1;
  int vertex_b = -1;
};

/// A mine plan made fit for use: walls that meet only at vertices, and an index that finds the near
/// ones at a cost that does not grow with the mine.
///
/// Immutable once built. Coordinates in metres in the map frame.
class LineMap {
 public:
  LineMap() = default;

  /// Snaps, splits at crossings and T-junctions, drops duplicates, merges collinear neighbours.
  static LineMap build(std::span<const Segment> raw, const LineMapOptions& options = {},
                       MapReport* report = nullptr);

  std::span<const Wall> walls() const { return walls_; }
  std::span<const Vector2d> vertices() const { return vertices_; }
  /// The walls that end at a vertex.
  std::span<const int> walls_at(int vertex) const {
    const auto begin = static_cast<std::size_t>(first_wall_at_[static_cast<std::size_t>(vertex)]);
    const auto end = static_cast<std::size_t>(first_wall_at_[static_cast<std::size_t>(vertex) + 1]);
    return {walls_at_.data() + begin, end - begin};
  }
  bool empty() const { return walls_.empty(); }

  /// Which build the map comes from: copies have it in common, no two builds do while it is held;
  /// null for a map that was not built. What is kept of a map's walls is kept with it, not with
  /// the map's address, where another may stand later.
  const std::shared_ptr<const void>& identity() const { return identity_; }

  /// The smallest box around all walls; empty for an empty map.
  const Box& bounds() const { return bounds_; }

  /// Appends to `found` the walls with a point within `radius` of `center`, each once, in ascending
  /// order. Allocates only while `found` grows.
  void near(const Vector2d& center, double radius, std::vector<int>& found) const;

 private:
  std::vector<Wall> walls_;  // along a Hilbert curve: near walls are near in memory
  std::vector<Vector2d> vertices_;
  std::vector<int> first_wall_at_;
  std::vector<int> walls_at_;
  SegmentIndex index_;
  Box bounds_;
  std::shared_ptr<const void> identity_;
};

}  // namespace adit
