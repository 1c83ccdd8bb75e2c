#pragma once

#include "adit/evaluation/report.hpp"
#include "adit/io/json.hpp"
#include "adit/map/line_map.hpp"

namespace adit {

/// The counts of cleaning a plan.
Json cleaning_report(const MapReport& cleaning);

/// What `adit evaluate --json` prints.
Json evaluation_report(const EvaluationReport& report);

}  // namespace adit
