#include "adit/relocation/view_search.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

#include "adit/relocation/wide_vectors.hpp"

namespace adit {
namespace {

constexpr std::size_t kMostFirstBins = 16;  // 16 times the largest cap fits a byte

/// The caps as bytes.
struct Caps {
  std::uint8_t shorter = 0;
  std::uint8_t longer = 0;
};

/// The codes twice over, so that every shift is a run of bytes, none beyond the scanner's sight.
struct DoubledBands {
  std::array<std::uint8_t, 2 * kRangeBins> nearest;
  std::array<std::uint8_t, 2 * kRangeBins> farthest;

  DoubledBands(const RangeBands& bands, std::uint8_t in_sight) {
    for (std::size_t b = 0; b < kRangeBins; ++b) {
      nearest[b] = std::min(bands.nearest[b], in_sight);
      farthest[b] = std::min(bands.farthest[b], in_sight);
    }
    std::memcpy(nearest.data() + kRangeBins, nearest.data(), kRangeBins);
    std::memcpy(farthest.data() + kRangeBins, farthest.data(), kRangeBins);
  }
};

/// Adds what one bin of the scan says against all headings of a place. In bytes throughout, so that
/// compilers make it vector instructions.
inline void add_bin(const DoubledBands& plan, std::size_t bin, const ScanCodes& scan, Caps caps,
                    std::array<std::uint8_t, kRangeBins>& costs) {
  const std::uint8_t* __restrict nearest = plan.nearest.data() + bin;
  const std::uint8_t* __restrict farthest = plan.farthest.data() + bin;
  std::uint8_t* __restrict sum = costs.data();
  const std::uint8_t shortest = scan.shortest[bin];
  const std::uint8_t longest = scan.longest[bin];
  for (std::size_t s = 0; s < kRangeBins; ++s) {
    const std::uint8_t far = farthest[s] > shortest ? farthest[s] : shortest;
    const std::uint8_t near = nearest[s] > longest ? nearest[s] : longest;
    const auto longer = static_cast<std::uint8_t>(far - farthest[s]);
    const auto shorter = static_cast<std::uint8_t>(near - longest);
    const std::uint8_t against_longer = longer < caps.longer ? longer : caps.longer;
    const std::uint8_t against_shorter = shorter < caps.shorter ? shorter : caps.shorter;
    sum[s] = static_cast<std::uint8_t>(sum[s] + against_longer + against_shorter);
  }
}

Caps caps_of(const RelocationOptions& options) {
  const auto byte = [](double value) {
    return static_cast<std::uint8_t>(std::clamp(value, 0.0, 15.0));
  };
  return {byte(options.shorter_cap), byte(options.longer_cap)};
}

using ShiftCosts = std::array<std::uint16_t, kRangeBins>;

/// What the bins say against a place at its best heading.
ADIT_WIDE std::uint8_t least_cost(const RangeBands& bands, const ScanCodes& scan,
                                  const std::vector<std::size_t>& bins, Caps caps) {
  const DoubledBands plan(bands, scan.farthest);
  std::array<std::uint8_t, kRangeBins> costs{};
  for (const std::size_t b : bins) add_bin(plan, b, scan, caps, costs);
  std::uint8_t least = costs[0];
  for (const std::uint8_t cost : costs) least = least < cost ? least : cost;
  return least;
}

/// What all bins say against each heading of a place.
ADIT_WIDE void compare_all(const RangeBands& bands, const ScanCodes& scan, Caps caps,
                           ShiftCosts& sums) {
  const DoubledBands plan(bands, scan.farthest);
  sums.fill(0);
  for (std::size_t first = 0; first < kRangeBins; first += kMostFirstBins) {
    std::array<std::uint8_t, kRangeBins> costs{};
    for (std::size_t b = first; b < first + kMostFirstBins; ++b) {
      if (scan.seen[b]) add_bin(plan, b, scan, caps, costs);
    }
    for (std::size_t s = 0; s < kRangeBins; ++s) {
      sums[s] = static_cast<std::uint16_t>(sums[s] + costs[s]);
    }
  }
}

using BlockCosts = std::array<std::uint8_t, PlaceIndex::kBlock>;

/// What a scan's sorted ranges say against the places of a block. What stands in the way makes
/// ranges shorter, nothing makes them longer: none of the scan's may be longer than the place's of
/// its rank; shorter ones only as many as things may hide.
ADIT_WIDE void rate_block(const PlaceIndex::SortedRanges& block,
                          std::span<const std::uint8_t> sorted, std::uint8_t in_sight,
                          BlockCosts& costs) {
  constexpr std::size_t kStep = kRangeBins / PlaceIndex::kRanks;
  constexpr double kMostHidden = 0.3;  // of the scan
  // Sixteen times both fit a byte.
  constexpr std::uint8_t kLongerCap = 8;
  constexpr std::uint8_t kShorterCap = 7;
  const auto hidden = static_cast<std::size_t>(kMostHidden * static_cast<double>(sorted.size()));
  costs.fill(0);
  for (std::size_t rank = 0; rank * kStep < sorted.size(); ++rank) {
    const std::uint8_t longest = sorted[sorted.size() - 1 - rank * kStep];
    const std::size_t beyond = rank * kStep + hidden;
    const std::uint8_t shortest = beyond < sorted.size() ? sorted[beyond] : in_sight;
    const std::uint8_t* __restrict far = block.longest[rank].data();
    const std::uint8_t* __restrict near = block.shortest[rank].data();
    for (std::size_t i = 0; i < PlaceIndex::kBlock; ++i) {
      const std::uint8_t reach = far[i] < in_sight ? far[i] : in_sight;
      const std::uint8_t front = near[i] < in_sight ? near[i] : in_sight;
      const auto longer = static_cast<std::uint8_t>((longest > reach ? longest : reach) - reach);
      const auto shorter =
          static_cast<std::uint8_t>((front > shortest ? front : shortest) - shortest);
      costs[i] = static_cast<std::uint8_t>(costs[i] + (longer < kLongerCap ? longer : kLongerCap) +
                                           (shorter < kShorterCap ? shorter : kShorterCap));
    }
  }
}

/// A heading of a place at which less speaks against it than at those beside it, in one number that
/// sorts by cost, place and heading.
struct Minimum {
  std::uint16_t cost = 0;
  std::uint32_t place = 0;
  std::uint8_t shift = 0;  // bins
  std::uint8_t part = 0;   // of a bin, from -1/2 on, in 255ths

  std::uint64_t key() const {
    return std::uint64_t{cost} << 48 | std::uint64_t{place} << 16 | std::uint64_t{shift} << 8 |
           part;
  }
  static Minimum of(std::uint64_t key) {
    return {static_cast<std::uint16_t>(key >> 48), static_cast<std::uint32_t>(key >> 16),
            static_cast<std::uint8_t>(key >> 8), static_cast<std::uint8_t>(key)};
  }
};

constexpr std::uint8_t kHalfBin = 127;  // parts

/// Of so many equal headings from the first one on: in their middle, or, of one alone, to the side
/// of its better neighbour, as far as a parabola has it.
Minimum minimum_of(std::uint32_t place, std::size_t first, std::size_t equal, int before, int after,
                   std::uint16_t cost) {
  int part = kHalfBin;
  if (equal == 1) {
    part += kHalfBin * (before - after) / std::max(1, before + after - 2 * cost);
  } else if (equal % 2 == 0) {
    part += kHalfBin;
  }
  const std::size_t middle = (first + (equal - 1) / 2) % kRangeBins;
  return {cost, place, static_cast<std::uint8_t>(middle), static_cast<std::uint8_t>(part)};
}

// No sum of costs is higher: all bins at the largest cap both ways.
constexpr std::size_t kMostCost = kRangeBins * 30 + 1;

}  // namespace

std::span<const PlaceMatch> ViewSearch::find(const PlaceIndex& index, const LaserScan& scan,
                                             const ScannerModel& scanner,
                                             const std::optional<SearchArea>& area,
                                             const RelocationOptions& options) {
  found_.clear();
  const ScanCodes codes = code_scan(scan, scanner, options.slack_ratio * index.pitch_m());
  if (codes.bins_seen == 0) return found_;
  rate_sorted(index, codes, area);
  const std::size_t all = places_.size();
  keep_places(part_of(all, options.rated_share, options.fewest_rated));
  choose_bins(codes, std::min(kMostFirstBins, count_of(options.first_bins)));
  rate_headings(index, codes, options);
  keep_places(part_of(all, options.compared_share, options.compared));
  compare(index, codes, options);
  thin_out(index, part_of(all, options.moved_share, options.moved), 2.0 * index.pitch_m());
  const auto per_step =
      static_cast<float>(options.agreement_per_step / static_cast<double>(codes.bins_seen));
  for (PlaceMatch& match : found_) match.score = -per_step * static_cast<float>(match.cost);
  return found_;
}

/// What the ranges say against each place, turned as it may be: sorted by length, the scan's must
/// not be longer than the place's, nor shorter.
void ViewSearch::rate_sorted(const PlaceIndex& index, const ScanCodes& scan,
                             const std::optional<SearchArea>& area) {
  std::vector<std::uint8_t> sorted;
  for (std::size_t b = 0; b < kRangeBins; ++b) {
    if (scan.seen[b]) sorted.push_back(scan.codes[b]);
  }
  std::sort(sorted.begin(), sorted.end());
  places_.clear();
  ratings_.clear();
  const auto blocks = index.sorted_ranges();
  BlockCosts costs;
  for (std::size_t block = 0; block < blocks.size(); ++block) {
    rate_block(blocks[block], sorted, scan.farthest, costs);
    const std::size_t first = block * PlaceIndex::kBlock;
    const std::size_t end = std::min(index.size(), first + PlaceIndex::kBlock);
    for (std::size_t place = first; place < end; ++place) {
      if (area && (index.position(place) - area->middle).norm() > area->radius_m) continue;
      places_.push_back(static_cast<std::uint32_t>(place));
      ratings_.push_back(costs[place - first]);
    }
  }
}

/// Keeps about so many places of the lowest ratings, and no fewer.
void ViewSearch::keep_places(std::size_t most) {
  std::array<std::size_t, 256> counts{};
  for (const std::uint8_t rating : ratings_) ++counts[rating];
  std::size_t sum = 0;
  std::size_t bound = 0;
  while (bound < 255 && (sum += counts[bound]) < most) ++bound;
  std::size_t kept = 0;
  for (std::size_t i = 0; i < places_.size(); ++i) {
    if (ratings_[i] <= bound) places_[kept++] = places_[i];
  }
  places_.resize(kept);
}

/// Evenly spread over those that the scanner sees.
void ViewSearch::choose_bins(const ScanCodes& scan, std::size_t count) {
  std::vector<std::size_t> seen;
  for (std::size_t b = 0; b < kRangeBins; ++b) {
    if (scan.seen[b]) seen.push_back(b);
  }
  bins_.clear();
  const std::size_t chosen = std::min(count, seen.size());
  for (std::size_t i = 0; i < chosen; ++i) bins_.push_back(seen[i * seen.size() / chosen]);
}

/// What the chosen bins say against each place at its best heading.
void ViewSearch::rate_headings(const PlaceIndex& index, const ScanCodes& scan,
                               const RelocationOptions& options) {
  const Caps caps = caps_of(options);
  ratings_.clear();
  for (const std::uint32_t place : places_) {
    ratings_.push_back(least_cost(index.codes(place), scan, bins_, caps));
  }
}

/// Every heading of a place that is better than its neighbours is a minimum.
void ViewSearch::compare(const PlaceIndex& index, const ScanCodes& scan,
                         const RelocationOptions& options) {
  const Caps caps = caps_of(options);
  minima_.clear();
  ShiftCosts sums;
  for (const std::uint32_t place : places_) {
    compare_all(index.codes(place), scan, caps, sums);
    for (std::size_t s = 0; s < kRangeBins; ++s) {
      const std::uint16_t before = sums[(s + kRangeBins - 1) % kRangeBins];
      if (!(sums[s] < before)) continue;
      std::size_t equal = 1;
      while (sums[(s + equal) % kRangeBins] == sums[s]) ++equal;
      const std::uint16_t after = sums[(s + equal) % kRangeBins];
      if (after < sums[s]) continue;
      minima_.push_back(minimum_of(place, s, equal, before, after, sums[s]).key());
    }
    // No heading is better than another.
    if (std::all_of(sums.begin(), sums.end(), [&](std::uint16_t sum) { return sum == sums[0]; })) {
      minima_.push_back(Minimum{sums[0], place, 0, kHalfBin}.key());
    }
  }
}

/// Sorts the minima by cost, those of the same cost as they are; no more than about so many of the
/// cheapest are kept.
void ViewSearch::sort_minima(std::size_t most) {
  std::array<std::uint32_t, kMostCost + 1> begins{};
  for (const std::uint64_t key : minima_) ++begins[Minimum::of(key).cost + std::size_t{1}];
  std::size_t bound = 0;
  while (bound + 1 < kMostCost && begins[bound] < most) {
    begins[bound + 1] += begins[bound];
    ++bound;
  }
  sorted_.resize(begins[bound]);
  for (const std::uint64_t key : minima_) {
    const std::size_t cost = Minimum::of(key).cost;
    if (cost < bound) sorted_[begins[cost]++] = key;
  }
}

/// The cheapest minima become matches, one of each cell and sector.
void ViewSearch::thin_out(const PlaceIndex& index, std::size_t most, double cell_m) {
  sort_minima(8 * most);
  cells_.clear(sorted_.size(), cell_m, 2.0 * kRangeBinWidth);
  for (const std::uint64_t key : sorted_) {
    if (found_.size() >= most) break;
    const Minimum minimum = Minimum::of(key);
    const Vector2d position = index.position(minimum.place);
    const double part = (minimum.part - 127.0) / 254.0;
    const double turn = (static_cast<double>(minimum.shift) + part) * kRangeBinWidth;
    const Pose2 pose{position.x(), position.y(), wrap_angle(turn)};
    if (cells_.insert(pose)) found_.push_back({pose, minimum.cost, 0.0F, 0.0F});
  }
}

}  // namespace adit
