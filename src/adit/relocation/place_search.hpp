#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "adit/relocation/place_index.hpp"

namespace adit {

/// Where to look: all of the plan, or near a position.
struct SearchArea {
  Vector2d middle = Vector2d::Zero();
  double radius_m = 0.0;
};

/// A pose of the scanner at which the codes of scan and plan agree.
struct PlaceMatch {
  Pose2 map_from_laser;
  std::uint16_t cost = 0;  ///< steps of the range code, summed over the bins
};

/// Holds a scan against every place of an index at every heading.
class PlaceSearch {
 public:
  /// The best matches, each better than all near it, best first. The same on every machine.
  std::span<const PlaceMatch> find(const PlaceIndex& index, const LaserScan& scan,
                                   const ScannerModel& scanner,
                                   const std::optional<SearchArea>& area,
                                   const RelocationOptions& options);

 private:
  using ShiftCosts = std::array<std::uint16_t, kRangeBins>;

  /// The scan as it would be from a place close by and turned a little.
  struct View {
    Pose2 eye_from_laser;
    ScanCodes codes;
  };

  void choose_bins(const ScanCodes& scan, std::size_t count);
  void rate(const PlaceIndex& index, const ScanCodes& scan, const std::optional<SearchArea>& area,
            const RelocationOptions& options);
  std::uint8_t bound_for(std::size_t kept) const;
  void lay_views(const LaserScan& scan, const ScannerModel& scanner, double pitch_m);
  void try_views(const PlaceIndex& index, std::size_t place, const RelocationOptions& options);
  void thin_out(double reach, std::size_t most);

  std::vector<std::size_t> bins_;      // that choose the places
  std::vector<std::uint32_t> places_;  // rated
  std::vector<std::uint8_t> ratings_;
  std::vector<View> views_;
  std::vector<PlaceMatch> matches_;
  std::vector<PlaceMatch> found_;
};

}  // namespace adit
