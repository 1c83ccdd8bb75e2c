#include "adit/relocation/place_search.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <tuple>

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
inline void add_bin(const DoubledBands& plan, std::size_t bin, std::uint8_t scan, Caps caps,
                    std::array<std::uint8_t, kRangeBins>& costs) {
  const std::uint8_t* __restrict nearest = plan.nearest.data() + bin;
  const std::uint8_t* __restrict farthest = plan.farthest.data() + bin;
  std::uint8_t* __restrict sum = costs.data();
  for (std::size_t s = 0; s < kRangeBins; ++s) {
    const std::uint8_t far = farthest[s] > scan ? farthest[s] : scan;
    const std::uint8_t near = nearest[s] > scan ? nearest[s] : scan;
    const auto longer = static_cast<std::uint8_t>(far - farthest[s]);
    const auto shorter = static_cast<std::uint8_t>(near - scan);
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

}  // namespace

std::span<const PlaceMatch> PlaceSearch::find(const PlaceIndex& index, const LaserScan& scan,
                                              const ScannerModel& scanner,
                                              const std::optional<SearchArea>& area,
                                              const RelocationOptions& options) {
  found_.clear();
  matches_.clear();
  const ScanCodes codes = code_scan(scan, scanner);
  if (index.empty() || codes.bins_seen == 0) return found_;
  choose_bins(codes, std::min<std::size_t>(kMostFirstBins, static_cast<std::size_t>(
                                                               std::max(1, options.first_bins))));
  rate(index, codes, area, options);
  lay_views(scan, scanner, index.pitch_m());
  const auto share =
      static_cast<std::size_t>(options.kept_share * static_cast<double>(places_.size()));
  const std::size_t kept =
      std::max(share, static_cast<std::size_t>(std::max(1, options.fewest_kept)));
  const std::uint8_t bound = bound_for(kept);
  for (std::size_t i = 0; i < places_.size(); ++i) {
    if (ratings_[i] <= bound) try_views(index, places_[i], options);
  }
  thin_out(0.75 * index.pitch_m(), static_cast<std::size_t>(std::max(1, options.candidates)));
  return found_;
}

/// Evenly spread over those that the scanner sees.
void PlaceSearch::choose_bins(const ScanCodes& scan, std::size_t count) {
  std::vector<std::size_t> seen;
  for (std::size_t b = 0; b < kRangeBins; ++b) {
    if (scan.seen[b]) seen.push_back(b);
  }
  bins_.clear();
  const std::size_t chosen = std::min(count, seen.size());
  for (std::size_t i = 0; i < chosen; ++i) bins_.push_back(seen[i * seen.size() / chosen]);
}

/// What the chosen bins say against each place at its best heading.
void PlaceSearch::rate(const PlaceIndex& index, const ScanCodes& scan,
                       const std::optional<SearchArea>& area, const RelocationOptions& options) {
  const Caps caps = caps_of(options);
  places_.clear();
  ratings_.clear();
  for (std::size_t place = 0; place < index.size(); ++place) {
    if (area && (index.position(place) - area->middle).norm() > area->radius_m) continue;
    const DoubledBands plan(index.codes(place), scan.farthest);
    std::array<std::uint8_t, kRangeBins> costs{};
    for (const std::size_t b : bins_) add_bin(plan, b, scan.codes[b], caps, costs);
    std::uint8_t least = costs[0];
    for (const std::uint8_t cost : costs) least = std::min(least, cost);
    places_.push_back(static_cast<std::uint32_t>(place));
    ratings_.push_back(least);
  }
}

/// The rating up to which about so many places are kept, and no fewer.
std::uint8_t PlaceSearch::bound_for(std::size_t kept) const {
  std::array<std::size_t, 256> counts{};
  for (const std::uint8_t rating : ratings_) ++counts[rating];
  std::size_t sum = 0;
  for (std::size_t rating = 0; rating < counts.size(); ++rating) {
    sum += counts[rating];
    if (sum >= kept) return static_cast<std::uint8_t>(rating);
  }
  return 255;
}

/// Views from a quarter of the places' distance off, so that one of them is near a place, each also
/// turned by half a bin.
void PlaceSearch::lay_views(const LaserScan& scan, const ScannerModel& scanner, double pitch_m) {
  views_.clear();
  for (const double x : {-0.25, 0.25}) {
    for (const double y : {-0.25, 0.25}) {
      for (const double turn : {0.0, 0.5}) {
        const Pose2 laser_from_eye{x * pitch_m, y * pitch_m, turn * kRangeBinWidth};
        views_.push_back({inverse(laser_from_eye), code_scan(scan, scanner, laser_from_eye)});
      }
    }
  }
}

/// Every heading of a place that is better than its neighbours becomes a match.
void PlaceSearch::try_views(const PlaceIndex& index, std::size_t place,
                            const RelocationOptions& options) {
  const Caps caps = caps_of(options);
  const DoubledBands plan(index.codes(place), views_.front().codes.farthest);
  const Vector2d position = index.position(place);
  for (const View& view : views_) {
    const ScanCodes& scan = view.codes;
    ShiftCosts sums{};
    for (std::size_t first = 0; first < kRangeBins; first += kMostFirstBins) {
      std::array<std::uint8_t, kRangeBins> costs{};
      for (std::size_t b = first; b < first + kMostFirstBins; ++b) {
        if (scan.seen[b]) add_bin(plan, b, scan.codes[b], caps, costs);
      }
      for (std::size_t s = 0; s < kRangeBins; ++s) {
        sums[s] = static_cast<std::uint16_t>(sums[s] + costs[s]);
      }
    }
    for (std::size_t s = 0; s < kRangeBins; ++s) {
      const std::uint16_t before = sums[(s + kRangeBins - 1) % kRangeBins];
      const std::uint16_t after = sums[(s + 1) % kRangeBins];
      if (!(sums[s] < before && sums[s] <= after)) continue;
      const Pose2 map_from_eye{position.x(), position.y(),
                               wrap_angle(static_cast<double>(s) * kRangeBinWidth)};
      matches_.push_back({map_from_eye * view.eye_from_laser, sums[s]});
    }
  }
}

/// The best matches, none near a better one.
void PlaceSearch::thin_out(double reach, std::size_t most) {
  const auto better = [](const PlaceMatch& a, const PlaceMatch& b) {
    if (a.cost != b.cost) return a.cost < b.cost;
    const Pose2& p = a.map_from_laser;
    const Pose2& q = b.map_from_laser;
    return std::tie(p.x, p.y, p.theta) < std::tie(q.x, q.y, q.theta);
  };
  const std::size_t looked_at = std::min(matches_.size(), 20 * most);
  std::partial_sort(matches_.begin(), matches_.begin() + static_cast<std::ptrdiff_t>(looked_at),
                    matches_.end(), better);
  for (std::size_t i = 0; i < looked_at && found_.size() < most; ++i) {
    const Pose2& pose = matches_[i].map_from_laser;
    const bool covered = std::any_of(found_.begin(), found_.end(), [&](const PlaceMatch& kept) {
      const Vector3d apart = difference(kept.map_from_laser, pose);
      return std::abs(apart.z()) < 1.1 * kRangeBinWidth && apart.head<2>().norm() < reach;
    });
    if (!covered) found_.push_back(matches_[i]);
  }
}

}  // namespace adit
