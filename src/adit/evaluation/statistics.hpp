#pragma once

#include <cstdint>
#include <limits>
#include <vector>

namespace adit {

/// Summary of a sample in the sample's own unit; all not-a-number where it is empty.
struct Statistics {
  static constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  std::int64_t count = 0;
  double mean = kNone;
  double rms = kNone;
  double median = kNone;
  double p95 = kNone;
  double p99 = kNone;
  double max = kNone;
};

/// Summarises magnitudes (not negative; infinity allowed, not-a-number not). Percentiles
/// interpolate linearly between the order statistics, the q-th lying at q (count - 1).
Statistics summarise(std::vector<double> magnitudes);

}  // namespace adit
