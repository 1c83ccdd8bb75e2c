#pragma once

#include <map>
#include <string>
#include <vector>

#include "adit/config/configuration.hpp"
#include "adit/io/log.hpp"

namespace adit {

/// Where what a log may tell of one of its lasers came from: "estimated from the log".
struct ScannerSources {
  std::string max_range_m;
  std::string quantisation_m;
  std::string range_sigma_m;
};

/// The settings that a log is replayed with, and where each that matters came from.
struct LogSettings {
  Configuration configuration;
  std::map<std::string, std::string> sources;  ///< by key; of a scanner, those of the first laser
  std::vector<ScannerSources> lasers;          ///< of each laser of the log's summary, in its order
};

/// What the configuration leaves open comes from the log's own fields, else is estimated from its
/// ranges, laser by laser: laser i of the log's summary is scanner i of the localizer. A key that
/// the configuration gives holds for all lasers. The log may hold a sample of its scans, all
/// through it, under the summary of all.
LogSettings settle(const LoadedConfiguration& loaded, const Log& log);

}  // namespace adit
