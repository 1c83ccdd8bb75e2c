#include "adit/places/range_code.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "adit/scan/returns.hpp"

namespace adit {
namespace {

constexpr double kFarthest = kPlaceCoding.farthest_m;
constexpr double kLinear = kPlaceCoding.linear_m;

}  // namespace

std::uint8_t range_code(double range_m) {
  static const double scale = kNothingInSight / std::log1p(kFarthest / kLinear);
  const double range = std::clamp(range_m, 0.0, kFarthest);
  return static_cast<std::uint8_t>(std::lround(scale * std::log1p(range / kLinear)));
}

ScanCodes code_scan(const LaserScan& scan, const ScannerModel& scanner, double slack_m) {
  ScanCodes out;
  const ReturnLimits limits = return_limits(scan, scanner);
  const double no_return = limits.none_from_m;
  out.farthest = range_code(no_return);
  std::array<std::vector<double>, kRangeBins> bins;
  for (std::size_t i = 0; i < scan.beams_of_one_turn(); ++i) {
    const double range = scan.ranges[i];
    const bool returned = limits.is_return(range);
    const double turns = (scan.bearing(i) + kPi) / kTwoPi;
    const double part = turns - std::floor(turns);
    const auto bin = std::min(kRangeBins - 1, static_cast<std::size_t>(part * kRangeBins));
    bins[bin].push_back(returned ? range : no_return);
  }
  for (std::size_t b = 0; b < kRangeBins; ++b) {
    if (bins[b].empty()) continue;
    std::sort(bins[b].begin(), bins[b].end());
    const std::size_t last = bins[b].size() - 1;
    out.codes[b] = range_code(bins[b][last / 2]);
    out.shortest[b] = range_code(bins[b][last / 4] - slack_m);
    out.longest[b] = range_code(bins[b][last - last / 4] + slack_m);
    out.seen[b] = true;
    ++out.bins_seen;
  }
  return out;
}

RangeBands code_ranges(std::span<const double> ranges, std::size_t margin) {
  RangeBands out;
  const std::size_t rays = ranges.size() / kRangeBins;
  for (std::size_t b = 0; b < kRangeBins; ++b) {
    double nearest = std::numeric_limits<double>::infinity();
    double farthest = 0.0;
    for (std::size_t i = 0; i < rays + 2 * margin; ++i) {
      const double range = ranges[(b * rays + i + ranges.size() - margin) % ranges.size()];
      nearest = std::min(nearest, range);
      farthest = std::max(farthest, range);
    }
    out.nearest[b] = range_code(nearest);
    out.farthest[b] = range_code(farthest);
  }
  return out;
}

}  // namespace adit
