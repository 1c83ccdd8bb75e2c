#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "adit/geometry/pose2.hpp"

namespace adit {

/// Where to look: all of the plan, or near a position.
struct SearchArea {
  Vector2d middle = Vector2d::Zero();
  double radius_m = 0.0;

  bool holds(const Vector2d& position) const {
    return (position - middle).squaredNorm() <= radius_m * radius_m;
  }
};

/// A pose of the scanner at which scan and plan agree.
struct PlaceMatch {
  Pose2 map_from_laser;
  std::uint16_t cost = 0;  ///< steps of the range code, summed over the bins
  float agreement = 0.0F;  ///< share of the returns that lie at a wall
  float score = 0.0F;      ///< less what speaks against the pose; more is better
};

/// A number of things, one at least.
inline std::size_t count_of(int number) { return static_cast<std::size_t>(std::max(1, number)); }

/// A share of so many, but no fewer than this and than one.
inline std::size_t part_of(std::size_t all, double share, int fewest) {
  const auto part = static_cast<std::size_t>(std::max(0.0, share) * static_cast<double>(all));
  return std::max(part, count_of(fewest));
}

}  // namespace adit
