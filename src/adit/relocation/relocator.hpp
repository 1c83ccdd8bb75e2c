#pragma once

#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

#include "adit/extraction/extraction.hpp"
#include "adit/map/line_map.hpp"
#include "adit/places/place_index.hpp"
#include "adit/refinement/refinement.hpp"
#include "adit/relocation/options.hpp"
#include "adit/relocation/place_search.hpp"
#include "adit/relocation/relocation_result.hpp"
#include "adit/relocation/scan_likelihood.hpp"
#include "adit/tracking/estimate.hpp"
#include "adit/tracking/verdict.hpp"

namespace adit {

/// Finds every pose in a mine that explains a scan, without any prior.
///
/// The index chooses places whose view resembles the scan (a scan shorter than the plan may be
/// something that stands there, one that is longer went through rock); likelihood and fit of all
/// points decide. Where the first look leaves a doubt, a second, wider one decides. Deterministic.
/// Map and index must outlive it.
class Relocator {
 public:
  Relocator(const LineMap& map, const PlaceIndex& index) : map_(map), index_(index) {}

  const RelocationResult& locate(const RelocationQuery& query,
                                 const RelocationOptions& options = {},
                                 const LikelihoodOptions& likelihood = {},
                                 const RefinementOptions& refinement = {},
                                 const StatusOptions& status = {});

  /// How many places are compared: those of the index, or corners.
  std::size_t places() const { return std::max(index_.size(), index_.corners().size()); }

 private:
  struct Hypothesis {
    Pose2 pose;  // map_from_vehicle
    double log_likelihood = 0.0;
  };

  void look(const RelocationQuery& query, std::span<const PlaceMatch> matches,
            const RelocationOptions& options, const LikelihoodOptions& likelihood);
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
