#pragma once

#include "counting.hpp"
#include "grounds.hpp"

namespace adit {

/// Looks for 20 single scans in a plan, with nothing known: a drive of a `locate` or `outside`
/// cell. Each has clutter of its own. An answer where none can be right is wrong. Error: a plan
/// cannot be read.
Result<DriveCounts> run_single_scans(const Cell& cell, Grounds& grounds, std::uint64_t base_seed,
                                     std::int64_t drive);

}  // namespace adit
