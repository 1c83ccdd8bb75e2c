#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "adit/config/configuration.hpp"
#include "adit/io/carmen.hpp"
#include "adit/io/estimates.hpp"
#include "adit/localizer/localizer.hpp"

namespace adit {

/// The settings that a log is replayed with, and where each that matters came from.
struct ReplaySettings {
  Configuration configuration;
  std::map<std::string, std::string>
      sources;  ///< "scanner.range_sigma_m" -> "estimated from the log"
};

/// What the configuration leaves open comes from the log's own fields, else is estimated from it.
ReplaySettings settle(const LoadedConfiguration& loaded, const Log& log);

/// A log through the localizer, in the log's order: one row and one set of timings a scan.
struct Replay {
  std::vector<EstimateRow> rows;
  std::vector<Timings> timings;
  std::vector<int> search_calls;
};
Replay replay(const Log& log, const LineMap& map, const LocalizerSettings& settings,
              const std::optional<Pose2>& start);

}  // namespace adit
