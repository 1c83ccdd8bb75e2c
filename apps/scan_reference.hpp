#pragma once

#include <cstddef>
#include <optional>
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

/// One scan of a log, or all.
struct ScanSelection {
  std::string log;
  std::optional<std::size_t> index;  ///< counted from 0; none for all
};

/// Reads `LOG:INDEX` or `LOG:all`.
Result<ScanSelection> parse_scan_selection(const std::string& text);

/// An Error where the log of that name has no scan of that number.
Result<void> check_index(std::size_t index, const Log& log, const std::string& name);

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
