#pragma once

#include <optional>
#include <span>
#include <vector>

#include "adit/map/spatial_index.hpp"

namespace adit {

/// A wall near a point.
struct NearWall {
  int wall = -1;
  double distance = 0.0;
  Vector2d point = Vector2d::Zero();  ///< of the wall, the nearest
};

/// Finds walls of like direction.
class LikeWalls {
 public:
  LikeWalls(std::span<const Segment> segments, double parallel_rad);

  /// The nearest within `reach`, and no farther than `beside` along the direction: a wall that
  /// goes on where another ends does not stand in its place.
  std::optional<NearWall> nearest(const Vector2d& p, const Vector2d& direction, double reach,
                                  double beside) const;

  /// Whether any wall, of whatever direction, is so near.
  bool any_within(const Vector2d& p, double reach) const;

  /// How many walls the way from one point to another crosses.
  int crossings(const Vector2d& from, const Vector2d& to) const;

 private:
  std::vector<Segment> segments_;
  SegmentIndex index_;
  double cosine_;
  double sine_;
};

}  // namespace adit
