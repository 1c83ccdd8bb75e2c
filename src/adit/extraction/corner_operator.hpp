#pragma once

#include <cstddef>
#include <vector>

#include "adit/extraction/scan_points.hpp"

namespace adit {

/// A straight stretch of the scan: the points [begin, end).
struct ScanStretch {
  std::size_t begin = 0;
  std::size_t end = 0;
  std::size_t size() const { return end - begin; }
};

/// The decisions of the corner operator.
struct CornerDecision {
  double chi_square = 25.0;  ///< what a second line must gain
  double straight_sigmas =
      4.0;  ///< how far above its mean the chi-square of a straight stretch may lie
  std::size_t min_points = 4;  ///< of an arm
};

/// The paper's corner operator (III-E): two lines that meet at a point of the scan, against one.
///
/// An operator of size L has arms of L metres. Sliding along the points, it costs O(1) a position
/// through prefix sums. All sizes are tried; a corner that a larger operator fits within noise is
/// taken from it, and the smaller ones are not asked again there.
class CornerOperator {
 public:
  /// One position of an operator, kept for pictures: response as chi-square gained by two lines.
  struct Response {
    std::size_t point = 0;
    std::size_t arm_begin = 0;
    std::size_t arm_end = 0;
    double gain = 0.0;
  };

  /// Appends the corners of a piece as cut positions (a cut at i lies between points i - 1 and i),
  /// ascending. `sizes` are the arms in metres, largest first.
  void find(const ScanPoints& points, ScanStretch piece, const std::vector<double>& sizes,
            const CornerDecision& decision, std::vector<std::size_t>& cuts);

 private:
  void slide(const ScanPoints& points, ScanStretch piece, double size,
             const CornerDecision& decision);
  void apply(const ScanPoints& points, ScanStretch window, std::size_t at);
  void settle(ScanStretch window);
  bool is_taken(std::size_t point) const;
  void accept_peaks(const ScanPoints& points, const CornerDecision& decision);

  std::vector<Response> responses_;
  std::vector<Response> accepted_;
  std::vector<char> settled_;  // of each point: whether smaller operators need not look there
};

/// Whether a stretch is straight within noise.
bool is_straight(const ScanPoints& points, ScanStretch stretch, double sigmas);

/// The cut in (begin + min_points, end - min_points) that two lines explain best, found by descent
/// from `start`, and what they gain over one line.
struct BestCut {
  std::size_t cut = 0;
  double gain = 0.0;
};
BestCut descend(const ScanPoints& points, ScanStretch stretch, std::size_t start,
                std::size_t min_points);

/// The same over all cuts of the stretch.
BestCut search(const ScanPoints& points, ScanStretch stretch, std::size_t min_points);

}  // namespace adit
