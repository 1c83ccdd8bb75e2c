#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "adit/geometry/angle.hpp"
#include "adit/places/coding.hpp"
#include "adit/scan/laser_scan.hpp"
#include "adit/scan/scanner_model.hpp"

namespace adit {

/// What is in sight around a place, as one byte of range in each of so many equal bearing bins.
inline constexpr std::size_t kRangeBins = kPlaceCoding.bins;
inline constexpr double kRangeBinWidth = kTwoPi / static_cast<double>(kRangeBins);  ///< rad
using RangeCodes = std::array<std::uint8_t, kRangeBins>;

/// A range as a byte, near linear close by and logarithmic far off: a step is as much as a place
/// and a heading that are a little off change the range. From 100 m on it is the same.
std::uint8_t range_code(double range_m);

/// The code of "nothing in sight".
inline constexpr std::uint8_t kNothingInSight = kPlaceCoding.nothing_in_sight;

/// A scan in the codes of the index, bin 0 from bearing -pi (laser axes).
struct ScanCodes {
  RangeCodes codes{};
  RangeCodes shortest{};  ///< as short as it may be from a place that is a little off ...
  RangeCodes longest{};   ///< ... and as long
  std::array<bool, kRangeBins> seen{};  ///< false outside of the field of view
  std::size_t bins_seen = 0;
  std::uint8_t farthest = kNothingInSight;  ///< the code of a beam that brings no return
};

/// The median range of each bin's beams; a beam without return counts as the farthest. From a place
/// that is off by `slack_m` they may be shorter and longer by as much, and where a bin has an edge,
/// either side of it may fill it.
ScanCodes code_scan(const LaserScan& scan, const ScannerModel& scanner, double slack_m = 0.0);

/// The shortest and the longest range in each bin and a little beside it: where the bearing decides
/// between near and far, either will do.
struct RangeBands {
  RangeCodes nearest{};
  RangeCodes farthest{};
};

/// The bands of what rays at evenly spaced bearings from -pi on meet (m, infinity for nothing), so
/// many a bin and `margin` more on either side.
RangeBands code_ranges(std::span<const double> ranges, std::size_t margin);

}  // namespace adit
