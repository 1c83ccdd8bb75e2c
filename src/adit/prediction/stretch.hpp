#pragma once

#include <cstddef>
#include <span>

#include "adit/visibility/visibility.hpp"

namespace adit {

/// What the view does where a stretch ends.
enum class StretchEnd {
  joined,  ///< another visible wall goes on from the same map vertex
  drop,    ///< the wall ends at a vertex and the view goes on behind it
  other,   ///< a shadow's edge, the range limit
};

/// A straight run of neighbouring visible intervals, counter-clockwise from `begin` to `end`.
struct VisibleStretch {
  Vector2d begin = Vector2d::Zero();  ///< relative to the observer, map axes (m)
  Vector2d end = Vector2d::Zero();
  int begin_vertex = -1;
  int end_vertex = -1;
  StretchEnd begin_kind = StretchEnd::other;
  StretchEnd end_kind = StretchEnd::other;
  int begin_wall = -1;  ///< the walls at its two ends, and the longest: indices in the map
  int end_wall = -1;
  int longest_wall = -1;
  std::size_t pieces = 0;  ///< how many intervals
};

/// The first interval that does not go straight on from the one before it (cyclically): where a
/// walk over the stretches may start.
std::size_t first_stretch(std::span<const VisibleInterval> intervals, double straight_m);

/// The stretch that starts with interval `first` and takes at most `limit` intervals, cyclically.
VisibleStretch stretch_from(std::span<const VisibleInterval> intervals, std::size_t first,
                            std::size_t limit, double straight_m);

}  // namespace adit
