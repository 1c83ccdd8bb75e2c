#pragma once

#include <optional>
#include <vector>

#include "adit/io/estimates.hpp"
#include "adit/io/log.hpp"
#include "adit/localizer/localizer.hpp"

namespace adit {

/// A log through the localizer, in the log's order: one row and one set of timings a scan.
struct Replay {
  std::vector<EstimateRow> rows;
  std::vector<Timings> timings;
  std::vector<int> search_calls;
  MapError map_error;  ///< as believed after the last scan
  StampCounts stamps;
};

/// Gives each scan its own odometry pose, and the localizer those of the log's ODOM messages that a
/// machine would have when the scan's sweep is over: all that the log has before the scan, and what
/// follows up to the sweep's end. Messages stamped by a clock that is not the scans' are left out.
Replay replay(const Log& log, const LineMap& map, const LocalizerSettings& settings,
              const std::optional<Pose2>& start);

}  // namespace adit
