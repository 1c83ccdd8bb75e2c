#pragma once

#include <optional>
#include <vector>

#include "adit/extraction/scan_points.hpp"
#include "adit/scan/laser_scan.hpp"

namespace adit {

/// How a scanner and the walls it looks at scatter, as scans themselves show it.
struct ScatterEstimate {
  double beam_sigma_m = 0.0;  ///< noise and rounding of a range, one sigma
  double roughness_m = 0.0;   ///< of the walls over four metres; 0 when lost in the noise
  int windows = 0;            ///< stretches that the estimate rests on
};

/// Learns the scatter from any scans of one scanner: short stretches of neighbouring points show
/// the noise, long ones the roughness of the walls. Corners and clutter only widen the upper end of
/// the distribution, so low quantiles are read: of the noise 30 %, scaled to what it is for
/// straight walls, of the roughness the median.
class ScatterEstimator {
 public:
  void add(const LaserScan& scan);

  /// Absent when too few stretches were seen.
  std::optional<ScatterEstimate> estimate() const;

 private:
  void add_short_windows(const ScanPoints::Piece& piece);
  void add_long_windows(const ScanPoints::Piece& piece);

  ScanPoints points_;
  std::vector<double> beam_variances_;
  struct LongWindow {
    double across_variance;  // of the points about their line
    double cos2;             // of the incidence
  };
  std::vector<LongWindow> long_windows_;
};

}  // namespace adit
