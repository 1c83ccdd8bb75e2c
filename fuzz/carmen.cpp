// A log is read or refused; what is read can be written and reads back as the same scans.
#include "adit/io/carmen.hpp"

#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <string_view>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto log = adit::parse_log({reinterpret_cast<const char*>(data), size}, {}, "log");
  if (!log) return 0;
  if (log->scans.empty()) std::abort();
  for (const adit::LogScan& entry : log->scans) {
    if (entry.scan.ranges.empty() || !std::isfinite(entry.scan.stamp)) std::abort();
    if (!(entry.scan.max_range > 0.0) || !std::isfinite(entry.scan.max_range)) std::abort();
    if (!entry.odom_from_vehicle.is_finite()) std::abort();
  }
  const auto again = adit::parse_log(adit::format_carmen(*log));
  if (!again || again->scans.size() != log->scans.size()) std::abort();
  for (std::size_t i = 0; i < log->scans.size(); ++i) {
    if (again->scans[i].scan.ranges.size() != log->scans[i].scan.ranges.size()) std::abort();
    if (again->scans[i].scan.stamp != log->scans[i].scan.stamp) std::abort();
  }
  return 0;
}
