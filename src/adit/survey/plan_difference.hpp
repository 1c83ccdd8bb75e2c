#pragma once

#include <span>
#include <string>
#include <vector>

#include "adit/survey/looked_at.hpp"
#include "adit/survey/walls.hpp"

namespace adit {

/// What a survey says of a piece of a plan, or of a wall that the plan lacks.
enum class PlanChange {
  gone,      ///< a wall of the plan through which beams went: a pillar robbed, a door, a cut
  moved,     ///< a wall of the plan that now stands beside its line: a rib that sloughed or was cut
  cut,       ///< a new wall behind a wall of the plan: what was mined since
  obstacle,  ///< a new wall in the plan's open space: a fall of roof, a stopping, a machine left
};

/// "wall gone", "wall moved", "new cut", "new obstacle".
const char* to_string(PlanChange change);

/// When a plan and a survey are the same.
struct PlanDifferenceOptions {
  double same_m = 0.4;
  double moved_m = 1.0;
  double parallel_rad = radians(30.0);
  double step_m = 0.1;
  double min_length_m = 1.0;
  double min_votes = 0.5;

  template <class Self, class Field>
  static void visit(Self& self, Field&& field) {
    field("same_m", self.same_m,
          "a surveyed wall no farther than this from the plan's is the same: three sigma of a plan "
          "of "
          "rough walls (m)");
    field("moved_m", self.moved_m,
          "a like wall no farther than this from one that is gone is that wall, moved (m)");
    field("parallel_rad", self.parallel_rad, "walls of the same direction within this (rad)");
    field("step_m", self.step_m, "walls are compared at places this far apart (m)");
    field("min_length_m", self.min_length_m, "shorter changes are not listed (m)");
    field("min_votes", self.min_votes,
          "visits that must have seen through a wall before it counts as gone");
  }
};

/// A stretch of one of the plan's segments.
struct PlanPiece {
  int segment = -1;
  SegmentPart stretch;
};

/// One change, to be looked at and accepted or not: neighbouring walls that changed alike are one.
struct PlanChangeItem {
  PlanChange change = PlanChange::gone;
  std::vector<PlanPiece> pieces;  ///< of the plan, that are removed
  std::vector<Segment> removed;   ///< the same
  std::vector<Segment> added;     ///< as surveyed
  double length_m = 0.0;
  double offset_m = 0.0;      ///< mean distance from the plan's line, of a moved wall
  double seen_through = 0.0;  ///< share of the visits' votes that saw through what is removed
  WallSupport support;        ///< of what is added
};

/// What changed, and how much of the plan was looked at (m).
struct PlanDifference {
  std::vector<PlanChangeItem> items;
  double confirmed_m = 0.0;
  double unseen_m = 0.0;  ///< of the plan; says nothing either way
};

/// Compares a plan with the walls surveyed in its frame; `scans` are those of the survey, and tell
/// what of the plan was seen through and what was not seen at all; they are gone through twice.
/// `visits` as of survey_walls(). An Error where the scans cannot be read.
Result<PlanDifference> compare_with_plan(std::span<const Segment> plan, const WallMap& walls,
                                         const PosedScans& scans, const ScannerModel& scanner,
                                         const PlanDifferenceOptions& options = {},
                                         const WallOptions& wall_options = {},
                                         std::span<const int> visits = {});

/// The plan with these changes made; all others stay proposals.
std::vector<Segment> apply_changes(std::span<const Segment> plan,
                                   std::span<const PlanChangeItem> accepted);

}  // namespace adit
