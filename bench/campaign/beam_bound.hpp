#pragma once

#include <optional>
#include <vector>

#include "adit/map/line_map.hpp"
#include "adit/simulation/scanner.hpp"
#include "adit/visibility/visibility.hpp"

namespace adit {

/// The Cramér-Rao bound of one scan from those of its beams alone that met walls of the mine, for
/// one who knows the mine and which beams these are.
class WallBeamBound {
 public:
  /// `mine` must outlive it.
  WallBeamBound(const LineMap& mine, const ScannerSpec& scanner) : mine_(mine), scanner_(scanner) {}

  /// Trace of the position's covariance (m²); nothing where these beams leave a direction open.
  /// `others` are outlines of what stands about.
  std::optional<double> position_variance(const LaserScan& scan, const Pose2& truth,
                                          const std::vector<Segment>& others);

 private:
  const LineMap& mine_;
  ScannerSpec scanner_;
  Visibility visibility_;
  std::vector<double> ranges_;
  std::vector<int> walls_;
};

}  // namespace adit
