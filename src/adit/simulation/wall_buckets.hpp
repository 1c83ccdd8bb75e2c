#pragma once

#include <span>
#include <vector>

#include "adit/geometry/segment.hpp"

namespace adit {

/// Walls in square buckets: exact distances from points and straight pieces to what is near.
class WallBuckets {
 public:
  WallBuckets() = default;
  /// Segments that are not finite are left out.
  explicit WallBuckets(std::span<const Segment> walls);

  /// Distance from the piece to the nearest wall (m), at most `reach`; 0 where they cross.
  double clearance(const Segment& piece, double reach) const;

  std::span<const Segment> walls() const { return walls_; }
  const Vector2d& corner() const { return corner_; }   ///< lower left of all walls
  const Vector2d& far_corner() const { return far_; }  ///< upper right of all walls

 private:
  int column(double x) const;
  int row(double y) const;
  template <class Visit>
  void visit_buckets(const Segment& segment, double margin, Visit&& visit) const;

  std::vector<Segment> walls_;
  Vector2d corner_ = Vector2d::Zero();
  Vector2d far_ = Vector2d::Zero();
  double bucket_m_ = 1.0;
  int columns_ = 0;
  int rows_ = 0;
  std::vector<int> first_in_bucket_;  // packed, as in RayCaster
  std::vector<int> entries_;
};

}  // namespace adit
