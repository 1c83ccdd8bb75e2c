#pragma once

#include <cstddef>
#include <optional>
#include <vector>

namespace adit {

/// How far apart two stamps of the same moment may lie by default (s).
inline constexpr double kJoinTolerance = 1e-3;

/// Finds rows by stamp in data whose stamps may repeat, run backwards or be not-a-number.
class StampIndex {
 public:
  explicit StampIndex(const std::vector<double>& stamps);

  /// The row nearest in time, if one lies within the tolerance. Of rows equally near the earlier
  /// stamp, of equal stamps the first row.
  std::optional<std::size_t> nearest(double stamp, double tolerance_s = kJoinTolerance) const;

 private:
  struct Entry {
    double stamp;
    std::size_t row;
  };
  std::vector<Entry> entries_;
};

/// The stamps of any rows that have a member `stamp`.
template <class Rows>
std::vector<double> stamps_of(const Rows& rows) {
  std::vector<double> stamps;
  stamps.reserve(rows.size());
  for (const auto& row : rows) stamps.push_back(row.stamp);
  return stamps;
}

}  // namespace adit
