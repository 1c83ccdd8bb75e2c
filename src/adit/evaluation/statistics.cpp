#include "adit/evaluation/statistics.hpp"

#include <algorithm>
#include <cmath>

namespace adit {
namespace {

double percentile(const std::vector<double>& sorted, double q) {
  const double place = q * static_cast<double>(sorted.size() - 1);
  const auto below = static_cast<std::size_t>(place);
  const double part = place - static_cast<double>(below);
  // Without this an infinite neighbour of weight zero would make a not-a-number.
  if (part == 0.0 || sorted[below] == sorted[below + 1]) return sorted[below];
  return sorted[below] + part * (sorted[below + 1] - sorted[below]);
}

}  // namespace

Statistics summarise(std::vector<double> magnitudes) {
  Statistics result;
  if (magnitudes.empty()) return result;
  std::sort(magnitudes.begin(), magnitudes.end());
  double sum = 0.0;
  double squares = 0.0;
  for (const double value : magnitudes) {
    sum += value;
    squares += value * value;
  }
  const auto count = static_cast<double>(magnitudes.size());
  result.count = static_cast<std::int64_t>(magnitudes.size());
  result.mean = sum / count;
  result.rms = std::sqrt(squares / count);
  result.median = percentile(magnitudes, 0.5);
  result.p95 = percentile(magnitudes, 0.95);
  result.p99 = percentile(magnitudes, 0.99);
  result.max = magnitudes.back();
  return result;
}

}  // namespace adit
