#pragma once

#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <string_view>

namespace adit {

/// Bounds of a probability.
struct Share {
  double low = 0.0;
  double high = 1.0;
};

/// The 95 % bounds of Clopper and Pearson 1934 of a probability that came true in `hits` of
/// `trials` independent trials; 0 to 1 where there are none.
Share clopper_pearson(std::int64_t hits, std::int64_t trials);

/// The regularised incomplete beta function I_x(a, b), a and b above zero, x in 0 to 1.
double incomplete_beta(double a, double b, double x);

/// A sample kept in bins that are 5 % wide, from the smallest to the largest number; what is not
/// above zero shares a bin, and so does infinity.
class Histogram {
 public:
  void add(double value, std::int64_t count = 1);
  void add(const Histogram& other);

  std::int64_t count() const { return count_; }
  /// How many values lie above `limit`, by the middles of their bins.
  std::int64_t above(double limit) const;
  /// The value that so large a part of the sample does not exceed, to 2.5 %; not-a-number where the
  /// sample is empty.
  double quantile(double part) const;
  /// The largest value, to 2.5 %; not-a-number where the sample is empty.
  double largest() const { return quantile(1.0); }

  /// "bin:count" joined by semicolons, "-" where it is empty.
  std::string text() const;
  /// Reads it back; nothing where it is no such text.
  static std::optional<Histogram> parse(std::string_view text);

  bool operator==(const Histogram&) const = default;

 private:
  static constexpr int kZero = std::numeric_limits<int>::min();
  static constexpr int kInfinite = std::numeric_limits<int>::max();
  static double value_of(int bin);

  std::map<int, std::int64_t> bins_;
  std::int64_t count_ = 0;
};

}  // namespace adit
