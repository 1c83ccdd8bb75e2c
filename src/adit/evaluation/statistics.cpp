#include "adit/evaluation/statistics.hpp"

#include <algorithm>
#include <cmath>

namespace adit {
double percentile(std::span<const double> ascending, double p) {
  if (ascending.empty()) return Statistics::kNone;
  // A product that rounding lifts above a whole number is that number.
  constexpr double kRounding = 1e-9;
  const auto count = static_cast<double>(ascending.size());
  const double rank = std::clamp(std::ceil(p * count - kRounding), 1.0, count);
  return ascending[static_cast<std::size_t>(rank) - 1];
}

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
