#pragma once

#include <cstdint>
#include <span>

#include "adit/simulation/world.hpp"

namespace adit {

/// Moves one wall of the plan, seen on the way, by 1 m along its normal. False where no wall can be
/// moved.
bool move_wall(World& world, std::uint64_t seed);

/// Makes a pillar, or a column at a wall, one that the plan does not know (even seeds) or that the
/// mine does not have (odd seeds). False where the world has neither.
bool remove_pillar(World& world, std::uint64_t seed);

/// Whether a point lies in an opening and not in rock, in a plan of closed outlines.
bool is_open(std::span<const Segment> plan, const Vector2d& point);

}  // namespace adit
