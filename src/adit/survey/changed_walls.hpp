#pragma once

#include <span>
#include <vector>

#include "adit/survey/plan_difference.hpp"

namespace adit {

/// A place on a wall of the plan whose change is certain.
struct ChangedPlace {
  Vector2d point = Vector2d::Zero();
  double offset_m = 0.0;
  double share_through = 0.0;
};

/// Neighbouring places of one segment of the plan that changed alike.
struct ChangedRun {
  PlanChange change = PlanChange::gone;
  PlanPiece piece;
  Segment removed;
  std::vector<ChangedPlace> places;
};

/// Which runs are one change: those that changed alike and whose ends meet. Each by its numbers,
/// ascending; in the order of their first.
std::vector<std::vector<std::size_t>> runs_of_changes(std::span<const ChangedRun> runs);

}  // namespace adit
