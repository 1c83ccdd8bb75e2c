#pragma once

#include <span>
#include <vector>

#include "adit/geometry/segment.hpp"

namespace adit {

/// A wall between two corners: a run of joined segments. A chain that goes all the way round
/// without a corner has the same point first and last.
struct WallChain {
  std::vector<Vector2d> points;  ///< two or more

  double length() const;
  bool is_closed() const { return points.size() > 2 && points.front() == points.back(); }
};

/// Chains of the walls: segments are joined where exactly two share an end (within a millimetre)
/// and turn by no more than `corner_rad`. Walls without length are left out.
std::vector<WallChain> chains_of(std::span<const Segment> walls, double corner_rad);

/// The chains' pieces, one chain after the other.
std::vector<Segment> segments_of(std::span<const WallChain> chains);

/// The part of the chain from `from` to `to` metres along it, 0 <= from < to <= length.
WallChain part_of(const WallChain& chain, double from, double to);

/// The same way with points so close that no piece is longer than `spacing` (m).
WallChain densified(const WallChain& chain, double spacing);

}  // namespace adit
