#include "scan_reference.hpp"

#include <charconv>
#include <cmath>
#include <string_view>

#include "configured.hpp"

namespace adit {

Result<ScanReference> parse_scan_reference(const std::string& text) {
  const std::size_t colon = text.rfind(':');
  const auto wrong = [&] {
    return fail("'" + text + "' is no scan: expected LOG:INDEX, scans counted from 0");
  };
  if (colon == std::string::npos || colon == 0 || colon + 1 == text.size()) return wrong();
  ScanReference reference{text.substr(0, colon), 0};
  const char* end = text.data() + text.size();
  const auto parsed = std::from_chars(text.data() + colon + 1, end, reference.index);
  if (parsed.ec != std::errc{} || parsed.ptr != end) return wrong();
  return reference;
}

Result<ScanSelection> parse_scan_selection(const std::string& text) {
  constexpr std::string_view kAll = ":all";
  if (text.size() > kAll.size() && text.ends_with(kAll)) {
    return ScanSelection{text.substr(0, text.size() - kAll.size()), std::nullopt};
  }
  const auto one = parse_scan_reference(text);
  if (one) return ScanSelection{one->log, one->index};
  return fail("'" + text + "' is no scan: expected LOG:INDEX, scans counted from 0, or LOG:all");
}

Result<void> check_index(std::size_t index, const Log& log, const std::string& name) {
  if (index < log.scans.size()) return {};
  return fail("has " + std::to_string(log.scans.size()) + " scans, no scan " +
                  std::to_string(index) + " (they count from 0)",
              name);
}

Result<ReferencedScan> read_referenced_scan(const ScanReference& reference,
                                            const LoadedConfiguration& configuration) {
  auto log = read_log(reference.log, log_options(configuration));
  if (!log) return tl::unexpected(log.error());
  if (const auto there = check_index(reference.index, *log, reference.log); !there) {
    return tl::unexpected(there.error());
  }
  ReferencedScan out{log->scans[reference.index], settle(configuration, *log), {}};
  const LaserScan& scan = out.scan.scan;
  const double sweep_s = out.settings.configuration.localizer.scanner_of(scan).sweep_s;
  for (const StampedPose& message : log->odometry) {
    if (std::abs(message.stamp - scan.stamp) <= 2.0 * sweep_s) out.odometry.push_back(message);
  }
  return out;
}

}  // namespace adit
