#pragma once

#include <string>
#include <vector>

#include "adit/io/json.hpp"
#include "survey_work.hpp"

namespace adit {

/// The list of changes: what each is, what it takes from the plan and adds to it, and what speaks
/// for it.
Json changes_report(const PlanDifference& difference);

/// What was read, with which settings, and what was found. Holds no wall-clock times.
Json survey_report(const Surveyed& surveyed);

/// A row for each piece of wall, or for each piece that a change removes or adds.
Result<void> write_walls(const WallMap& walls, const std::string& path);
Result<void> write_changes(const PlanDifference& difference, const std::string& path);

/// A picture of the survey, or of the changes where there are any to speak of.
Result<void> draw_surveyed(const Surveyed& surveyed, const std::string& path);

/// The list of changes for the terminal, numbered from 1.
std::string changes_summary(const PlanDifference& difference);

}  // namespace adit
