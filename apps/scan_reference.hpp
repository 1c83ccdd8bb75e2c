#pragma once

#include <string>

#include "adit/geometry/result.hpp"
#include "adit/io/log.hpp"
#include "replay.hpp"

namespace adit {

/// One scan of a log, and the settings that its whole log would be replayed with.
struct ReferencedScan {
  LogScan scan;
  ReplaySettings settings;
};

/// Reads `LOG:INDEX`, scans counted from 0, under a configuration file (may be empty).
Result<ReferencedScan> read_referenced_scan(const std::string& reference,
                                            const std::string& configuration);

}  // namespace adit
