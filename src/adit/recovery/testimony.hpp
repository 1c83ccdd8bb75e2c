#pragma once

#include "adit/refinement/refinement.hpp"
#include "adit/tracking/pose_tracker.hpp"
#include "adit/tracking/verdict.hpp"

namespace adit {

/// What scans are fitted and judged by.
struct FitRules {
  const LineMap& map;
  const RefinementOptions& refinement;
  const TrackingOptions& tracking;
  const StatusOptions& status;
};

/// What a scan says of a pose.
enum class Testimony {
  blind,        ///< nothing: hardly a beam came back
  contradicts,  ///< the pose does not explain it
  weak,         ///< it does, but for much of the scan
  open,         ///< it explains most of the scan, which leaves a direction open
  sure,         ///< it explains most of the scan, which shows all of the pose
};

/// Of a fit; "most" is more than this share of what a scan of nothing but the map's walls gives.
Testimony testimony_of(const ScanFit& fit, const StatusOptions& status, double sure_evidence_ratio);

/// How likely a scan is from a pose, and how much of that is news: correlated beams say the same.
/// Finite: a fit that came to nothing is very unlikely.
struct Witness {
  double log_likelihood = 0.0;
  double share_of_news = 0.0;
  bool sees = false;  ///< returns enough to say something
};
Witness witness_of(const ScanFit& fit);

/// The pose, no surer than a fit may begin.
PoseWithCovariance loosened(const PoseWithCovariance& pose);

/// The fit as the filter takes it.
PoseObservation observation_of(const ScanFit& fit);

}  // namespace adit
