#pragma once

#include <span>
#include <vector>

#include "adit/geometry/segment.hpp"

namespace adit {

/// Least distance between two segments (m); 0 where they meet.
double distance_between(const Segment& s, const Segment& t);

/// The vehicle's way as segments; a pose far from the next one stands for itself.
std::vector<Segment> way_of(std::span<const Pose2> path);

/// Whether all of `s` is at least `clearance` (m) from every link of a way as `way_of` makes it.
bool is_clear_of(std::span<const Segment> way, const Segment& s, double clearance);

}  // namespace adit
