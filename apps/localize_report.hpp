#pragma once

#include <string>

#include "adit/calibration/log_settings.hpp"
#include "adit/io/json.hpp"
#include "adit/map/line_map.hpp"
#include "replay.hpp"

namespace adit {

/// Where a run began, and on which level of the plan (empty where it has none).
struct RunOrigin {
  std::string start;
  std::string level;
};

/// report.json of `adit localize`: what was read, with which settings, and how it went. Holds no
/// wall-clock times.
Json localize_report(const LogSettings& settings, const MapReport& cleaning, const LogSummary& log,
                     const RunOrigin& origin, const Replay& replay);

/// The settings that are not the defaults' own: each with its value and where it came from.
Json settings_report(const LogSettings& settings);

/// What the reading of a log met, laser by laser.
Json log_report(const LogSummary& log, const LogSettings& settings);

/// timings.json: microseconds by stage, over the scans that had it.
Json timings_report(const std::vector<Timings>& timings);

/// A few lines for the terminal: statuses, how sure the poses are, and stamps that were odd.
std::string localize_summary(const Replay& replay);

}  // namespace adit
