#include "scan_reference.hpp"

#include <charconv>

namespace adit {

Result<ReferencedScan> read_referenced_scan(const std::string& reference,
                                            const std::string& configuration) {
  const std::size_t colon = reference.rfind(':');
  std::size_t index = 0;
  const char* end = reference.data() + reference.size();
  if (colon == std::string::npos ||
      std::from_chars(reference.data() + colon + 1, end, index).ptr != end ||
      colon + 1 == reference.size()) {
    return fail("'" + reference + "' is no scan: expected LOG:INDEX, scans counted from 0");
  }
  LoadedConfiguration loaded;
  if (!configuration.empty()) {
    auto read = read_configuration(configuration);
    if (!read) return tl::unexpected(read.error());
    loaded = std::move(*read);
  }
  const std::string file = reference.substr(0, colon);
  auto log = read_log(file);
  if (!log) return tl::unexpected(log.error());
  if (index >= log->scans.size()) {
    return fail("has " + std::to_string(log->scans.size()) + " scans, no scan " +
                    std::to_string(index) + " (they count from 0)",
                file);
  }
  return ReferencedScan{log->scans[index], settle(loaded, *log)};
}

}  // namespace adit
