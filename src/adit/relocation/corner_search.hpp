#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "adit/extraction/extraction.hpp"
#include "adit/places/place_index.hpp"
#include "adit/relocation/options.hpp"
#include "adit/relocation/place_match.hpp"
#include "adit/relocation/pose_cells.hpp"
#include "adit/relocation/quick_fit.hpp"

namespace adit {

/// Takes each corner of a scan for every corner of the plan that opens as wide. A corner and the
/// walls that make it fix a full pose, so one of each is a hypothesis (Shaffer et al. 1992: "to try
/// all matches"); a handful of returns says which deserve a closer look.
class CornerSearch {
 public:
  /// The poses at which most of those returns lie at walls, no more than so many, in the order of
  /// the plan's corners.
  std::span<const PlaceMatch> find(const PlaceIndex& index, const LaserScan& scan,
                                   const ScannerModel& scanner,
                                   const std::optional<SearchArea>& area, std::size_t most,
                                   const CornerSearchOptions& options);

  /// The same of the last search, which was in this index, but so many.
  std::span<const PlaceMatch> take(const PlaceIndex& index, std::size_t most);

 private:
  /// A corner of the scan.
  struct Sensed {
    float x = 0.0F;  // laser axes (m)
    float y = 0.0F;
    float along_x = 1.0F;  // unit vector along the wall at which its space begins
    float along_y = 0.0F;
    float opening = 0.0F;    // rad
    float end_share = 0.5F;  // how much the other wall says about the heading
    double arm_m = 0.0;      // length of the shorter wall
    double gap_m = 0.0;      // from where the walls end to where they meet, the farther one
  };

  /// A pair of corners and what the returns say of it.
  struct Ranked {
    std::uint8_t rating = 0;
    std::uint32_t sensed = 0;
    std::uint32_t sector = 0;  // of the plan
  };

  void sense(const LaserScan& scan, const ScannerModel& scanner);
  void choose_corners(const CornerIndex& corners);
  template <class Each>
  void for_each_pair(const CornerIndex& corners, const Each& each) const;
  void rate(const PlaceIndex& index, const std::optional<SearchArea>& area);
  CornerIndex::Likeness likeness(const Sensed& sensed) const;
  void keep_one_of_each_cell(const PlaceIndex& index, std::size_t most);
  Pose2 pose_of(const Ranked& ranked, const PlaceIndex& index) const;
  static QuickFit::Placed place(const Sensed& sensed, const Sector& sector);

  Extractor extractor_;
  CornerSearchOptions options_;  // of the last search
  QuickFit few_returns_;
  std::vector<Sensed> sensed_;
  std::vector<std::uint8_t> ratings_;  // of each sensed corner and each of the plan that is like it
  std::vector<Ranked> ranked_;
  PoseCells cells_;
  std::vector<PlaceMatch> found_;
};

}  // namespace adit
