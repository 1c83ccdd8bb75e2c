#include "adit/evaluation/join.hpp"

#include <algorithm>
#include <cmath>

namespace adit {

StampIndex::StampIndex(const std::vector<double>& stamps) {
  entries_.reserve(stamps.size());
  for (std::size_t row = 0; row < stamps.size(); ++row) {
    if (std::isfinite(stamps[row])) entries_.push_back({stamps[row], row});
  }
  std::stable_sort(entries_.begin(), entries_.end(),
                   [](const Entry& a, const Entry& b) { return a.stamp < b.stamp; });
}

std::optional<std::size_t> StampIndex::nearest(double stamp, double tolerance_s) const {
  if (!std::isfinite(stamp) || entries_.empty()) return std::nullopt;
  const auto first_not_before = [this](double wanted) {
    return std::lower_bound(entries_.begin(), entries_.end(), wanted,
                            [](const Entry& entry, double value) { return entry.stamp < value; });
  };
  auto best = first_not_before(stamp);
  if (best != entries_.begin()) {
    const double before = std::prev(best)->stamp;
    if (best == entries_.end() || stamp - before <= best->stamp - stamp) {
      best = first_not_before(before);
    }
  }
  if (std::abs(best->stamp - stamp) > tolerance_s) return std::nullopt;
  return best->row;
}

}  // namespace adit
