#include "adit/plot/ticks.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

namespace adit {

double round_down(double value) {
  if (!(value > 0.0) || !std::isfinite(value)) return 1.0;
  const double decade = std::pow(10.0, std::floor(std::log10(value)));
  for (const double factor : {10.0, 5.0, 2.0}) {
    if (factor * decade <= value * (1.0 + 1e-9)) return factor * decade;
  }
  return decade;
}

std::vector<double> ticks(double lower, double upper, int most) {
  std::vector<double> values;
  if (!(upper > lower) || !std::isfinite(upper - lower) || most < 1) return values;
  // The smallest round step with no more than `most` of it in the range.
  const double step = 1.0 / round_down(most / (upper - lower));
  const double first = std::ceil(lower / step - 1e-9);
  for (int i = 0; i <= 2 * most; ++i) {
    const double value = (first + i) * step;
    if (value > upper + 1e-9 * step) break;
    values.push_back(value);
  }
  return values;
}

std::vector<double> decade_ticks(double lower, double upper, int most) {
  std::vector<double> values;
  if (!(lower > 0.0) || !(upper > lower) || !std::isfinite(upper) || most < 1) return values;
  const double first = std::ceil(std::log10(lower) - 1e-9);
  const double last = std::floor(std::log10(upper) + 1e-9);
  const double stride = std::max(1.0, std::ceil((last - first + 1.0) / most));
  for (double power = first; power <= last; power += stride)
    values.push_back(std::pow(10.0, power));
  return values;
}

std::string tick_text(double value, double step) {
  const double magnitude = step > 0.0 ? std::floor(std::log10(step) + 1e-9) : 0.0;
  const int decimals = static_cast<int>(std::clamp(-magnitude, 0.0, 12.0));
  std::array<char, 400> buffer{};
  const auto [end, error] = std::to_chars(buffer.data(), buffer.data() + buffer.size(),
                                          std::abs(value), std::chars_format::fixed, decimals);
  if (error != std::errc()) return "?";
  std::string text(buffer.data(), end);
  const bool is_zero = text.find_first_not_of("0.") == std::string::npos;
  return value < 0.0 && !is_zero ? "\u2212" + text : text;
}

}  // namespace adit
