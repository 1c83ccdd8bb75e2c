#pragma once

#include <cstdint>
#include <limits>
#include <span>
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

/// The percentile of values in ascending order by nearest rank: the ceil(p count)-th of them, with
/// p from 0 (the least) to 1 (the largest); the median of an even number is the lower of the middle
/// two. Not-a-number where there are none.
double percentile(std::span<const double> ascending, double p);

/// Summarises magnitudes (not negative; infinity allowed, not-a-number not), with percentiles by
/// nearest rank.
Statistics summarise(std::vector<double> magnitudes);

}  // namespace adit
