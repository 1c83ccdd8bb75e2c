#pragma once

#include <optional>

#include "adit/estimation/estimation.hpp"
#include "adit/extraction/extraction.hpp"
#include "adit/localizer/settings.hpp"
#include "adit/localizer/sweep.hpp"
#include "adit/localizer/timings.hpp"
#include "adit/map/line_map.hpp"
#include "adit/matching/matching.hpp"
#include "adit/visibility/visibility.hpp"

namespace adit {

/// What the features of a scan say of the vehicle's pose.
struct FeatureFix {
  bool is_believable = false;
  PoseWithCovariance vehicle;  ///< map_from_vehicle; of use where it is believable
};

/// The paper's part: the pose from features, matched to those that the map promises. Keeps its
/// buffers.
class FeatureFitter {
 public:
  /// Map and settings must outlive it.
  FeatureFitter(const LineMap& map, const LocalizerSettings& settings)
      : map_(map), settings_(settings) {}

  /// `map_sigma_m` is what a wall may lie off its line (m).
  FeatureFix fit(const Sweep& sweep, const PoseWithCovariance& predicted, double map_sigma_m,
                 Timings& timings);
  /// Forgets the last fit.
  void clear();

  /// Of the last fit. Model features are relative to the predicted position of the laser, in the
  /// map's axes; sensed ones are in the laser's frame.
  const FeatureList& model() const { return model_; }
  const MatchResult& match() const { return match_; }
  const FeatureFit& result() const { return fit_; }
  const Extractor& extractor() const { return extractor_; }
  std::span<const FeaturePair> pairs_used() const { return estimator_.pairs_used(); }

 private:
  void predict(const Sweep& sweep, const PoseWithCovariance& laser, Timings& timings);
  void extract(const Sweep& sweep, Timings& timings);
  void match_to(const PoseWithCovariance& laser, Timings& timings);
  void estimate(const PoseWithCovariance& laser, double map_sigma_m, Timings& timings);
  bool is_believable(const PoseWithCovariance& laser) const;

  const LineMap& map_;
  const LocalizerSettings& settings_;
  Visibility visibility_;
  Extractor extractor_;
  Matcher matcher_;
  FeatureEstimator estimator_;
  FeatureList model_;
  FeatureList model_in_laser_;
  MatchResult match_;
  FeatureFit fit_;
};

}  // namespace adit
