#pragma once

#include <span>

#include "adit/map/line_map.hpp"
#include "adit/map/plan_graph.hpp"

namespace adit {

/// Cleans a plan: the edges of the result meet only at common vertices, none has zero length and no
/// two are equal. Vertices of no edge may be left over. Counts what was done into `report`, whose
/// `output` it leaves to the caller.
///
/// Every usable raw wall longer than the tolerances stays within 4 snap_m + merge_offset_m of the
/// result, and every edge of the result as near to a raw wall.
PlanGraph clean_plan(std::span<const Segment> raw, const LineMapOptions& options,
                     MapReport& report);

}  // namespace adit
