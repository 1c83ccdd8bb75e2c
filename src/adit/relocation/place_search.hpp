#pragma once

#include <optional>
#include <span>
#include <vector>

#include "adit/relocation/corner_search.hpp"
#include "adit/relocation/options.hpp"
#include "adit/relocation/quick_fit.hpp"
#include "adit/relocation/view_search.hpp"

namespace adit {

/// Where in a plan a scan may have been taken: where its view resembles that from a place of the
/// index, or a corner of it one of the plan's. All are moved onto the walls, and the best chosen.
class PlaceSearch {
 public:
  /// The best matches, each better than all near it, best first. The same on every machine.
  std::span<const PlaceMatch> find(const PlaceIndex& index, const LaserScan& scan,
                                   const ScannerModel& scanner,
                                   const std::optional<SearchArea>& area,
                                   const RelocationOptions& options);

  /// The same for the scan of the last search, in the same index and area, by other limits of how
  /// many; what corners are taken for stays as it was.
  std::span<const PlaceMatch> find_again(const PlaceIndex& index, const LaserScan& scan,
                                         const ScannerModel& scanner,
                                         const std::optional<SearchArea>& area,
                                         const RelocationOptions& options);

 private:
  std::span<const PlaceMatch> move(const PlaceIndex& index, const LaserScan& scan,
                                   const ScannerModel& scanner, std::span<const PlaceMatch> views,
                                   std::span<const PlaceMatch> corners,
                                   const RelocationOptions& options);
  void approach(const WallField& walls, std::span<const PlaceMatch> matches, std::size_t most);
  void settle(const WallField& walls, const RelocationOptions& options);
  void choose(const RelocationOptions& options);

  ViewSearch view_search_;
  CornerSearch corner_search_;
  QuickFit quick_fit_;
  std::vector<PlaceMatch> approached_;
  std::vector<PlaceMatch> matches_;
  std::vector<PlaceMatch> found_;
};

}  // namespace adit
