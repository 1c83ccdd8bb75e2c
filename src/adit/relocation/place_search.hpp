#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "adit/relocation/place_index.hpp"
#include "adit/relocation/quick_fit.hpp"

namespace adit {

/// Where to look: all of the plan, or near a position.
struct SearchArea {
  Vector2d middle = Vector2d::Zero();
  double radius_m = 0.0;
};

/// A pose of the scanner at which scan and plan agree.
struct PlaceMatch {
  Pose2 map_from_laser;
  std::uint16_t cost = 0;  ///< steps of the range code, summed over the bins
  float agreement = 0.0F;  ///< share of the returns that lie at a wall
  float score = 0.0F;      ///< of both; more is better
};

/// Holds a scan against every place of an index at every heading: first the ranges whatever the
/// heading, then some bearings, then all, ever fewer places; the best are moved onto the walls.
class PlaceSearch {
 public:
  /// The best matches, each better than all near it, best first. The same on every machine.
  std::span<const PlaceMatch> find(const PlaceIndex& index, const LaserScan& scan,
                                   const ScannerModel& scanner,
                                   const std::optional<SearchArea>& area,
                                   const RelocationOptions& options);

 private:
  void rate_sorted(const PlaceIndex& index, const ScanCodes& scan,
                   const std::optional<SearchArea>& area);
  void keep_places(std::size_t most);
  void choose_bins(const ScanCodes& scan, std::size_t count);
  void rate_headings(const PlaceIndex& index, const ScanCodes& scan,
                     const RelocationOptions& options);
  void compare(const PlaceIndex& index, const ScanCodes& scan, const RelocationOptions& options);
  void sort_minima(std::size_t most);
  void thin_out(const PlaceIndex& index, std::size_t most, double cell_m);
  void keep_best(std::size_t most);
  void choose(std::size_t fewest, std::size_t most, float slack);

  std::vector<std::uint32_t> places_;  // still in the race
  std::vector<std::uint8_t> ratings_;  // what speaks against each
  std::vector<std::size_t> bins_;      // that choose among them
  std::vector<std::uint64_t> minima_;  // of what speaks against their places, by heading
  std::vector<std::uint64_t> sorted_;
  QuickFit quick_fit_;
  std::vector<std::uint64_t> taken_;  // cells of matches that were kept, a hash table
  std::vector<PlaceMatch> matches_;
  std::vector<PlaceMatch> found_;
};

}  // namespace adit
