#pragma once

#include <string>

#include "adit/evaluation/report.hpp"
#include "adit/io/json.hpp"
#include "replay.hpp"

namespace adit {

/// report.json of `adit localize`: what was read, with which settings, and how it went. Holds no
/// wall-clock times.
Json localize_report(const std::string& estimator, const ReplaySettings& settings,
                     const MapReport& cleaning, const LogSummary& log, const Replay& replay);

/// timings.json: microseconds by stage.
Json timings_report(const std::vector<Timings>& timings);

/// A few lines for the terminal.
std::string localize_summary(const Replay& replay);

/// The counts of cleaning a plan.
Json cleaning_report(const MapReport& cleaning);

/// What `adit evaluate --json` prints.
Json evaluation_report(const EvaluationReport& report);

}  // namespace adit
