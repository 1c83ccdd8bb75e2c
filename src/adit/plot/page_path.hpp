#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "adit/geometry/pose2.hpp"

namespace adit {

/// A rectangle on the page, in points from its upper left corner.
struct PageRect {
  Vector2d min = Vector2d::Zero();
  Vector2d size = Vector2d::Zero();

  Vector2d max() const { return min + size; }
  Vector2d center() const { return min + 0.5 * size; }
  PageRect padded(double by) const {
    return {min - Vector2d::Constant(by), size + Vector2d::Constant(2.0 * by)};
  }
  bool contains(const Vector2d& p) const {
    return p.x() >= min.x() && p.y() >= min.y() && p.x() <= max().x() && p.y() <= max().y();
  }
};

/// Equal scale in x and y, y up in the world and down on the page.
struct WorldToPage {
  Vector2d world_center = Vector2d::Zero();  ///< m
  Vector2d page_center = Vector2d::Zero();   ///< points
  double scale = 1.0;                        ///< points per metre

  Vector2d operator()(const Vector2d& p) const {
    return {page_center.x() + scale * (p.x() - world_center.x()),
            page_center.y() - scale * (p.y() - world_center.y())};
  }
};

/// Polylines: one list of points, cut where a new polyline starts.
struct PathPoints {
  std::vector<Vector2d> points;
  std::vector<std::size_t> starts;

  void begin() { starts.push_back(points.size()); }
  std::size_t count() const { return starts.size(); }
  std::span<const Vector2d> part(std::size_t i) const {
    const std::size_t end = i + 1 < starts.size() ? starts[i + 1] : points.size();
    return std::span(points).subspan(starts[i], end - starts[i]);
  }
};

/// The paths on the page: cut at the border of `window`, and without what the eye cannot tell
/// apart (points closer than a twentieth of a point, pieces drawn twice), so that a picture's size
/// is bounded by its ink and not by its data. Points that are not finite interrupt a line.
PathPoints to_page(const PathPoints& world, const WorldToPage& map, const PageRect& window);

}  // namespace adit
