#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "adit/places/place_index.hpp"
#include "adit/relocation/options.hpp"
#include "adit/relocation/place_match.hpp"
#include "adit/relocation/pose_cells.hpp"

namespace adit {

/// Holds the view of a scan against that from every place of an index at every heading: first the
/// ranges whatever the heading, then some bearings, then all, of ever fewer places.
class ViewSearch {
 public:
  /// The poses against which least speaks, the best first; their scores are no higher than zero.
  /// The same on every machine.
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

  std::vector<std::uint32_t> places_;  // still in the race
  std::vector<std::uint8_t> ratings_;  // what speaks against each
  std::vector<std::size_t> bins_;      // that choose among them
  std::vector<std::uint64_t> minima_;  // of what speaks against their places, by heading
  std::vector<std::uint64_t> sorted_;
  PoseCells cells_;  // of those that were found
  std::vector<PlaceMatch> found_;
};

}  // namespace adit
