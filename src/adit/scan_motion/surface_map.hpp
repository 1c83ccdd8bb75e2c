#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "adit/scan_motion/surface_points.hpp"

namespace adit {

/// Points of walls, found by place: which of them is nearest to a point and faces the same way.
///
/// Points that share a small cell and a facing are merged into their mean, so that a wall seen
/// often costs no more than one seen once and scatters less.
class SurfaceMap {
 public:
  /// The side of the cells in which points are merged, and of those in which they are looked for
  /// (m).
  explicit SurfaceMap(double merge_m = 0.06, double reach_m = 0.3)
      : merge_m_(merge_m), reach_m_(reach_m) {}

  void clear();
  /// Adds points, carried into the frame of the map. `index` must follow, once, before the search.
  void add(std::span<const SurfacePoint> points, const RigidTransform& map_from_points);
  void index();

  /// The nearest point within `reach` (m) whose normal is turned by no more than 45 degrees; null
  /// if there is none.
  const SurfacePoint* nearest(const Eigen::Vector2f& point, const Eigen::Vector2f& normal,
                              float reach) const;

  std::span<const SurfacePoint> points() const { return points_; }

 private:
  struct Cell {
    std::int64_t key = kEmpty;
    std::uint32_t begin = 0;
    std::uint32_t end = 0;
  };
  static constexpr std::int64_t kEmpty = INT64_MIN;

  const Cell* find(std::int64_t key) const;
  void merge();
  void bucket();

  double merge_m_;
  double reach_m_;
  std::vector<SurfacePoint> raw_;
  std::vector<SurfacePoint> points_;  // merged, ordered by cell
  std::vector<Cell> table_;
  std::uint64_t mask_ = 0;
};

}  // namespace adit
