#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "adit/geometry/pose2.hpp"

namespace adit {

/// Which squares of a plan and sectors of headings hold a pose: a hash table that keeps its memory.
class PoseCells {
 public:
  /// Forgets all; no more than so many are put in. Sectors are as wide as a 127th of a turn at
  /// least.
  void clear(std::size_t most, double cell_m, double sector_rad) {
    slots_.assign(std::bit_ceil(2 * most + 2), kFree);
    cell_m_ = cell_m;
    sector_rad_ = std::max(sector_rad, kTwoPi / 127.0);
  }

  /// False if its cell holds a pose already.
  bool insert(const Pose2& pose) {
    const std::uint64_t cell = cell_of(pose);
    const std::size_t mask = slots_.size() - 1;
    std::size_t slot = (cell * 0x9E3779B97F4A7C15u >> 20) & mask;
    while (slots_[slot] != kFree) {
      if (slots_[slot] == cell) return false;
      slot = (slot + 1) & mask;
    }
    slots_[slot] = cell;
    return true;
  }

 private:
  static constexpr std::uint64_t kFree = ~std::uint64_t{0};

  std::uint64_t cell_of(const Pose2& pose) const {
    const auto whole = [](double value) {
      return static_cast<std::uint64_t>(static_cast<std::int64_t>(std::floor(value)));
    };
    constexpr std::uint64_t kMask = (std::uint64_t{1} << 28) - 1;
    const std::uint64_t sector = whole((pose.theta + kPi) / sector_rad_);
    return (sector & 127) << 56 | (whole(pose.x / cell_m_) & kMask) << 28 |
           (whole(pose.y / cell_m_) & kMask);
  }

  std::vector<std::uint64_t> slots_;
  double cell_m_ = 1.0;
  double sector_rad_ = 0.1;
};

}  // namespace adit
