#pragma once

#include <span>

#include "adit/map/snapping.hpp"

namespace adit {

/// Splits edges until those listed in `suspects` meet no other edge away from a common vertex:
/// where two cross, both are split at a vertex; where an end touches an edge, that edge is split
/// there and led through the end. An end touches within half the fine tolerance, or within `touch`
/// (m) where it is farther than that from the ends of the edge and not farther from the edge as it
/// was given: repeated splits cannot carry an edge away. Edges that are not listed must not meet
/// each other.
void resolve_meetings(PlanGraph& plan, std::span<const int> suspects, double touch,
                      const CleaningTolerances& tolerances, MapReport& report);

}  // namespace adit
