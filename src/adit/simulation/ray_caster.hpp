#pragma once

#include <limits>
#include <span>
#include <vector>

#include "adit/geometry/segment.hpp"

namespace adit {

/// Metres from `origin` along the unit vector `direction` to the segment, or infinity.
///
/// Ends belong to the segment (with a nanometre to spare, so that joined walls do not leak). A ray
/// along the segment passes it by, and so does a ray that starts on it.
double cast_ray(const Segment& segment, const Vector2d& origin, const Vector2d& direction);

/// The nearest of all segments within `max_range`, or infinity: plain brute force, the oracle of
/// everything in adit that is faster.
double cast_ray(std::span<const Segment> segments, const Vector2d& origin,
                const Vector2d& direction,
                double max_range = std::numeric_limits<double>::infinity());

/// The same numbers, bit for bit, from a uniform grid: for many beams or a million segments.
class RayCaster {
 public:
  RayCaster() = default;
  /// Segments that are not finite are left out.
  explicit RayCaster(std::span<const Segment> segments);

  double range(const Vector2d& origin, const Vector2d& direction,
               double max_range = std::numeric_limits<double>::infinity()) const;

 private:
  struct Cell {
    int x = 0;
    int y = 0;
  };
  void lay_grid();
  template <class Visit>
  void visit_cells(const Segment& segment, Visit&& visit) const;
  int column(double x) const;
  int row(double y) const;
  double range_in_cell(const Cell& cell, const Vector2d& origin, const Vector2d& direction) const;

  std::vector<Segment> segments_;
  Vector2d corner_ = Vector2d::Zero();  // lower left
  double cell_m_ = 1.0;
  int columns_ = 0;
  int rows_ = 0;
  std::vector<int> first_in_cell_;  // packed: the entries of cell c are [first[c], first[c + 1])
  std::vector<int> entries_;
};

}  // namespace adit
