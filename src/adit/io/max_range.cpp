#include "adit/io/max_range.hpp"

#include <algorithm>
#include <cmath>

namespace adit {
namespace {

constexpr double kBinsPerMetre = 100.0;
constexpr double kCodesWithin = 0.02;    // of the top code: SICK's codes span 0.1 %
constexpr std::uint32_t kPeakOver = 5;   // times the fullest of the occupied bins just below
constexpr std::uint64_t kOverAbove = 4;  // times all that lies above it
constexpr int kBinsBelow = 10;
constexpr double kApart = 1.5;  // a value this many times the next lower one stands alone
constexpr std::uint64_t kTopShare = 1000;   // one beam in so many: the rarest top code
constexpr std::uint64_t kNextShare = 2000;  // likewise for further codes below it
constexpr std::uint32_t kNextFewest = 20;

}  // namespace

void MaxRangeFinder::add(std::span<const double> ranges) {
  for (const double range : ranges) {
    if (!(range > 0.0) || !std::isfinite(range)) continue;
    ++total_;
    if (range > kFarthest) {
      ++beyond_;
      continue;
    }
    largest_ = std::max(largest_, range);
    const auto index = static_cast<std::size_t>(range * kBinsPerMetre + 0.5);
    if (index >= bins_.size()) bins_.resize(index + 1);
    Bin& bin = bins_[index];
    ++bin.count;
    if (bin.votes == 0) bin.value = range;
    bin.votes += bin.value == range ? 1 : -1;
  }
}

bool MaxRangeFinder::stands_out(std::size_t bin) const {
  const std::uint32_t count = bins_[bin].count;
  std::uint32_t fullest = 0;
  int met = 0;
  for (std::size_t i = bin; i-- > 0 && met < kBinsBelow;) {
    if (bins_[i].count == 0) continue;
    if (met == 0 && count >= 2 && bins_[bin].value >= kApart * bins_[i].value) return true;
    fullest = std::max(fullest, bins_[i].count);
    ++met;
  }
  return count >= 2 && count / kPeakOver >= fullest && count >= total_ / kTopShare;
}

std::optional<std::size_t> MaxRangeFinder::top_code() const {
  std::uint64_t above = beyond_;
  for (std::size_t i = bins_.size(); i-- > 0;) {
    const std::uint32_t count = bins_[i].count;
    if (count == 0) continue;
    if (count >= kOverAbove * above && stands_out(i)) return i;
    above += count;
    if (2 * above > total_) break;
  }
  return std::nullopt;
}

std::optional<double> MaxRangeFinder::find(std::optional<double> declared) const {
  const std::optional<std::size_t> top = top_code();
  if (!top) return std::nullopt;
  const double ceiling = declared.value_or(bins_[*top].value);
  std::optional<double> lowest;
  if (!declared) lowest = bins_[*top].value;
  for (std::size_t i = *top + 1; i-- > 0;) {
    const Bin& bin = bins_[i];
    if (bin.count == 0) continue;
    if (bin.value < (1.0 - kCodesWithin) * ceiling) break;
    if (bin.value > ceiling) continue;
    const bool frequent = bin.count >= kNextFewest && bin.count >= total_ / kNextShare;
    if (i == *top || (frequent && stands_out(i))) lowest = bin.value;
  }
  return lowest;
}

}  // namespace adit
