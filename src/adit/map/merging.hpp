#pragma once

#include <vector>

#include "adit/map/snapping.hpp"

namespace adit {

/// Joins chains of edges over vertices where just two meet: the longest runs such that every vertex
/// left out lies beside the joined edge, within the merge offset of it. A curve keeps as many
/// vertices as that takes. Returns the joined edges that left the old line by more than rounding:
/// they may meet others now.
std::vector<int> merge_chains(PlanGraph& plan, const CleaningTolerances& tolerances,
                              MapReport& report);

/// The vertices of a polyline that a greedy simplification keeps, as ascending indices with the
/// first and the last: each one left out lies within `offset` (m) of the segment between the kept
/// ones around it. Linear in the length of the line (the cone of Williams, Comput. J. 1978).
void simplify(std::span<const Vector2d> line, double offset, std::vector<int>& kept);

}  // namespace adit
