#pragma once

#include <cstdint>
#include <vector>

#include "adit/map/box.hpp"

namespace adit {

/// Points of the plane in a hashed grid: finds the nearest one within a small radius in constant
/// time. Points keep their numbers, 0 upward in the order of adding.
class VertexGrid {
 public:
  /// `tolerance` (m, above zero) is the usual search radius; the cells are sized for it.
  VertexGrid(double tolerance, std::size_t expected_count);

  const std::vector<Vector2d>& positions() const { return positions_; }
  const Vector2d& position(int vertex) const {
    return positions_[static_cast<std::size_t>(vertex)];
  }

  /// Adds a point, however near others are.
  int add(const Vector2d& point);
  /// Moves a point. Cells are not updated: every search widens by the farthest move instead, so
  /// moves are to stay small.
  void move(int vertex, const Vector2d& to);
  /// The point nearest to `center` within `radius`, other than `except`; ties go to the lower
  /// number; -1 for none.
  int nearest(const Vector2d& center, double radius, int except = -1) const;

 private:
  struct Cell {
    std::int64_t x = 0;
    std::int64_t y = 0;
  };
  Cell cell_of(double x, double y) const;
  std::size_t bucket_of(Cell cell) const;
  void link(int vertex);
  void grow();

  double cells_per_metre_;
  double farthest_move_ = 0.0;
  std::vector<Vector2d> positions_;
  std::vector<Vector2d> homes_;  // positions at the time of adding: what the cells know
  std::vector<int> next_;        // chain of the bucket, -1 ends
  std::vector<int> first_;       // buckets: a power of two of them
};

}  // namespace adit
