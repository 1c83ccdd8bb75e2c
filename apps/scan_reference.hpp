#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "adit/calibration/log_settings.hpp"
#include "adit/geometry/result.hpp"
#include "adit/io/log.hpp"

namespace adit {

/// One scan of a log, as the command line names it.
struct ScanReference {
  std::string log;
  std::size_t index = 0;  ///< counted from 0
};

/// Reads `LOG:INDEX`.
Result<ScanReference> parse_scan_reference(const std::string& text);

/// One scan of a log, and the settings that its whole log would be replayed with.
struct ReferencedScan {
  LogScan scan;
  LogSettings settings;
  std::vector<StampedPose> odometry;  ///< the ODOM messages around its sweep
};

/// Reads the scan from its log, as `localize` does under the same configuration.
Result<ReferencedScan> read_referenced_scan(const ScanReference& reference,
                                            const LoadedConfiguration& configuration);

}  // namespace adit
