#include "statistics.hpp"

#include <fmt/core.h>

#include <charconv>
#include <cmath>

namespace adit {
namespace {

constexpr double kBinRatio = 1.05;

/// The continued fraction of the incomplete beta function by Lentz's method (Abramowitz and Stegun
/// 26.5.8); converges fast for x below (a + 1) / (a + b + 2).
double beta_fraction(double a, double b, double x) {
  constexpr double kTiny = 1e-300;
  constexpr double kEnough = 1e-15;
  constexpr int kMost = 10000;
  const auto kept_apart = [](double value) { return std::abs(value) < kTiny ? kTiny : value; };
  double c = 1.0;
  double d = 1.0 / kept_apart(1.0 - (a + b) * x / (a + 1.0));
  double fraction = d;
  for (int m = 1; m < kMost; ++m) {
    const double even = m * (b - m) * x / ((a + 2.0 * m - 1.0) * (a + 2.0 * m));
    const double odd = -(a + m) * (a + b + m) * x / ((a + 2.0 * m) * (a + 2.0 * m + 1.0));
    double step = 1.0;
    for (const double term : {even, odd}) {
      d = 1.0 / kept_apart(1.0 + term * d);
      c = kept_apart(1.0 + term / c);
      step = c * d;
      fraction *= step;
    }
    if (std::abs(step - 1.0) < kEnough) break;
  }
  return fraction;
}

/// The x at which a function that grows from 0 to 1 reaches `level`.
template <class Function>
double where(double level, Function&& function) {
  double low = 0.0;
  double high = 1.0;
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    (function(middle) < level ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

template <class Number>
bool read(std::string_view text, Number& number) {
  const char* end = text.data() + text.size();
  const auto parsed = std::from_chars(text.data(), end, number);
  return parsed.ec == std::errc{} && parsed.ptr == end;
}

}  // namespace

double incomplete_beta(double a, double b, double x) {
  if (x <= 0.0) return 0.0;
  if (x >= 1.0) return 1.0;
  const double log_factor =
      std::lgamma(a + b) - std::lgamma(a) - std::lgamma(b) + a * std::log(x) + b * std::log1p(-x);
  const double factor = std::exp(log_factor);
  if (x < (a + 1.0) / (a + b + 2.0)) return factor * beta_fraction(a, b, x) / a;
  return 1.0 - factor * beta_fraction(b, a, 1.0 - x) / b;
}

Share clopper_pearson(std::int64_t hits, std::int64_t trials) {
  constexpr double kTail = 0.025;
  Share bounds;
  const auto k = static_cast<double>(hits);
  const auto n = static_cast<double>(trials);
  if (hits > 0) {
    bounds.low = where(kTail, [&](double p) { return incomplete_beta(k, n - k + 1.0, p); });
  }
  if (hits < trials) {
    bounds.high = where(1.0 - kTail, [&](double p) { return incomplete_beta(k + 1.0, n - k, p); });
  }
  return bounds;
}

void Histogram::add(double value, std::int64_t count) {
  int bin = kZero;
  if (!std::isfinite(value)) {
    bin = kInfinite;
  } else if (value > 0.0) {
    bin = static_cast<int>(std::lround(std::log(value) / std::log(kBinRatio)));
  }
  bins_[bin] += count;
  count_ += count;
}

void Histogram::add(const Histogram& other) {
  for (const auto& [bin, count] : other.bins_) bins_[bin] += count;
  count_ += other.count_;
}

double Histogram::value_of(int bin) {
  if (bin == kZero) return 0.0;
  return bin == kInfinite ? std::numeric_limits<double>::infinity() : std::pow(kBinRatio, bin);
}

std::int64_t Histogram::above(double limit) const {
  std::int64_t sum = 0;
  for (const auto& [bin, count] : bins_) sum += value_of(bin) > limit ? count : 0;
  return sum;
}

double Histogram::quantile(double part) const {
  if (count_ == 0) return std::numeric_limits<double>::quiet_NaN();
  const double wanted = part * static_cast<double>(count_);
  std::int64_t sum = 0;
  for (const auto& [bin, count] : bins_) {
    sum += count;
    if (static_cast<double>(sum) >= wanted) return value_of(bin);
  }
  return value_of(bins_.rbegin()->first);
}

std::string Histogram::text() const {
  std::string text;
  for (const auto& [bin, count] : bins_) {
    if (!text.empty()) text += ';';
    text += bin == kZero ? "zero" : bin == kInfinite ? "inf" : fmt::format("{}", bin);
    text += fmt::format(":{}", count);
  }
  return text.empty() ? "-" : text;
}

std::optional<Histogram> Histogram::parse(std::string_view text) {
  Histogram histogram;
  if (text == "-") return histogram;
  while (true) {
    const std::string_view entry = text.substr(0, text.find(';'));
    const std::size_t colon = entry.find(':');
    if (colon == std::string_view::npos) return std::nullopt;
    const std::string_view name = entry.substr(0, colon);
    int bin = name == "zero" ? kZero : kInfinite;
    std::int64_t count = 0;
    if (name != "zero" && name != "inf" && !read(name, bin)) return std::nullopt;
    if (!read(entry.substr(colon + 1), count) || count <= 0) return std::nullopt;
    histogram.bins_[bin] += count;
    histogram.count_ += count;
    if (entry.size() == text.size()) return histogram;
    text.remove_prefix(entry.size() + 1);
  }
}

}  // namespace adit
