#pragma once

#include <optional>
#include <vector>

#include "adit/refinement/refinement.hpp"
#include "adit/relocation/fit_quality.hpp"
#include "adit/relocation/place_match.hpp"
#include "adit/relocation/scan_likelihood.hpp"
#include "adit/tracking/estimate.hpp"

namespace adit {

/// A pose of the vehicle that explains a scan.
struct RankedPose {
  Pose2 pose;  ///< map_from_vehicle
  /// Over (x, y, theta), map frame; what the scan leaves open is as wide as the search's basin.
  Matrix3d covariance = Matrix3d::Zero();
  double weight = 0.0;  ///< of all listed, summing to one
  double log_likelihood = 0.0;
  FitQuality quality;
};

/// Where a scan may have been taken, the most plausible first.
struct RelocationResult {
  /// `ok`: one pose explains the scan. `degraded`: one, but the scan leaves a direction of it open.
  /// `ambiguous`: several do. `lost`: none.
  Status verdict = Status::lost;
  std::vector<RankedPose> poses;
  /// How much less likely the best of the other poses is than the first (log, of what is news), as
  /// far as that counts (`hopeless_gap`).
  double gap = 0.0;
  BeamShares shares;           ///< at the first pose
  int lines = 0;               ///< of the scan, long enough to count (`line_m`)
  MapError map_error;          ///< how much the plan errs by this scan; no more than stated
  bool is_cut_off = false;     ///< more explain the scan than were fitted or are listed
  double share_of_news = 1.0;  ///< what counts of differences of the log likelihoods
};

/// A scan to be found, and what is known beside it.
struct RelocationQuery {
  const LaserScan& scan;
  const ScannerModel& scanner;
  const MapError& map_error;
  std::optional<SweepPrior> motion;  ///< during the sweep, of a scanner that takes its time
  std::optional<SearchArea> within;  ///< of the scanner's position; none looks everywhere
};

}  // namespace adit
