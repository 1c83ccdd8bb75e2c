#pragma once

#include <optional>
#include <span>
#include <vector>

#include "adit/extraction/extraction.hpp"
#include "adit/map/line_map.hpp"
#include "adit/refinement/refinement.hpp"
#include "adit/relocation/options.hpp"
#include "adit/relocation/place_index.hpp"
#include "adit/relocation/place_search.hpp"
#include "adit/relocation/scan_likelihood.hpp"
#include "adit/tracking/estimate.hpp"
#include "adit/tracking/verdict.hpp"

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

/// Finds every pose in a mine that explains a scan, without any prior.
///
/// The index chooses places whose view resembles the scan (a scan shorter than the plan may be
/// something that stands there, one that is longer went through rock); likelihood and fit of all
/// points decide. Where others come near the best, a second look that thins out less must say the
/// same. Deterministic. Map and index must outlive it.
class Relocator {
 public:
  Relocator(const LineMap& map, const PlaceIndex& index) : map_(map), index_(index) {}

  const RelocationResult& locate(const RelocationQuery& query,
                                 const RelocationOptions& options = {},
                                 const LikelihoodOptions& likelihood = {},
                                 const RefinementOptions& refinement = {},
                                 const StatusOptions& status = {});

 private:
  struct Hypothesis {
    Pose2 pose;  // map_from_vehicle
    double log_likelihood = 0.0;
  };

  Status look(const RelocationQuery& query, std::span<const PlaceMatch> matches,
              const RelocationOptions& options, const LikelihoodOptions& likelihood,
              const StatusOptions& status);
  void fit_coarsely(const RelocationQuery& query, const RelocationOptions& options);
  void narrow_down(const RelocationQuery& query, const RelocationOptions& options);
  void fit_thinned(const RelocationQuery& query, const MapError& error,
                   const RelocationOptions& options);
  void drop_hopeless(const RelocationOptions& options);
  void rate_by_likeliest_error(const RelocationQuery& query, double doubt_m,
                               const RelocationOptions& options);
  void fit_all_points(const RelocationQuery& query, const RelocationOptions& options);
  double likelihood_at(const RelocationQuery& query, const Pose2& map_from_vehicle, double doubt_m);
  const ScanFit& fit(const RefinementInput& input, const Pose2& pose,
                     const RelocationOptions& options, const RefinementOptions& refinement);
  void take_fits(const RelocationQuery& query, const MapError& error,
                 const RelocationOptions& options);
  void weigh(const RelocationOptions& options);
  double gap_to_others(const RelocationOptions& options) const;
  void count_lines(const RelocationQuery& query, const RelocationOptions& options);
  void examine_best(const RelocationQuery& query, const LikelihoodOptions& likelihood);
  bool stands_alone(const RelocationQuery& query, const RelocationOptions& options) const;
  Status verdict(const RelocationQuery& query, const RelocationOptions& options,
                 const StatusOptions& status) const;

  const LineMap& map_;
  const PlaceIndex& index_;
  PlaceSearch search_;
  ScanLikelihood likelihood_;
  ScanLikelihood all_beams_;
  Extractor extractor_;
  Refiner refiner_;
  RefinementOptions refinement_;
  RefinementOptions coarse_refinement_;  // of the first fits, with some of the beams
  LaserScan thinned_;
  std::vector<Hypothesis> hypotheses_;
  RelocationResult result_;
};

}  // namespace adit
