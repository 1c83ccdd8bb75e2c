#pragma once

#include <string>
#include <vector>

#include "adit/io/plan.hpp"

namespace adit {

/// A level of a mine: its name, empty where the plan is a single file, and its walls.
struct PlanLevel {
  std::string name;
  Plan plan;
};

/// Reads a plan of one file, or a folder of which each plan file is a level of that name without
/// its ending, in the order of the names.
///
/// Of a folder `.csv` and `.txt` files are read; what has another ending, begins with a dot or is
/// no file is passed over. Errors as `read_plan`; a folder without a plan; two files of one name.
Result<std::vector<PlanLevel>> read_plan_levels(const std::string& path);

}  // namespace adit
