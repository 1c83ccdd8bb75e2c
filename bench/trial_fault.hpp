#pragma once

#include <optional>

#include "trial_run.hpp"

namespace adit {

/// Moves one wall of the plan, seen on the way, by 1 m along its normal. Returns the plan that
/// would be right; nothing where no wall can be moved.
std::optional<std::vector<Segment>> move_wall(World& world, std::uint64_t seed);

/// Makes a pillar, or a column at a wall, one that the plan does not know (even seeds) or that the
/// mine does not have (odd seeds). Returns the plan that would be right; nothing where the world
/// has neither.
std::optional<std::vector<Segment>> remove_pillar(World& world, std::uint64_t seed);

/// Marks the scans that see a difference between the plan that the localizer has and the real one.
void mark_affected(const LineMap& real, TrialRun& run);

/// Lets the wheels report 30 % more than the vehicle moves, in bursts of some metres.
void slip_in_bursts(std::uint64_t seed, TrialRun& run);

/// Whether a point lies in an opening and not in rock, in a plan of closed outlines.
bool is_open(std::span<const Segment> plan, const Vector2d& point);

}  // namespace adit
