#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "adit/localizer/feature_fitter.hpp"
#include "adit/localizer/settings.hpp"
#include "adit/localizer/sweep.hpp"
#include "adit/localizer/timings.hpp"
#include "adit/refinement/map_error.hpp"
#include "adit/refinement/refinement.hpp"

namespace adit {

/// Where the vehicle may be before the scan is looked at.
struct Expectation {
  PoseWithCovariance vehicle;               ///< by dead reckoning
  std::optional<PoseWithCovariance> rival;  ///< another that may be the true one, by its own
  bool is_anywhere = false;                 ///< nothing is known: no fit
  bool is_doubted = false;                  ///< the last scans speak for looking at features
  bool was_all_shown = false;               ///< the last scan left no direction open
};

/// Another fit that explains the scan, in another place.
struct OtherFit {
  ScanFit fit;
  double lead = 0.0;  ///< of the best fit over it, log of the odds
};

/// What the stages found of one scan.
struct Fits {
  ScanFit best;                   ///< of all points
  std::optional<ScanFit> rival;   ///< at the expected rival
  std::optional<OtherFit> other;  ///< about as plausible as the best
  bool uses_features = false;     ///< features were matched
  FeatureFix features;            ///< what they say
};

/// The last fits in detail; views the fitter's buffers.
struct FitDetails {
  const FeatureFit& features;
  std::span<const FeaturePair> pairs;  ///< of features that the fit used
  std::span<const BeamResidual> beams;
  std::span<const double> on_wall;   ///< probability of each beam to have met its wall
  std::span<const WallShare> walls;  ///< what each wall contributed
  double map_sigma_m = 0.0;          ///< what a wall may lie off its line, as learnt (m)
  const ScannerModel& scanner;
};

/// Fits scans to the map: by features where the prediction is too unsure or the scan is not clear,
/// and by all points. Learns the map's error from the residuals of the fits that it is told to.
class Fitter {
 public:
  /// Map and settings must outlive it.
  Fitter(const LineMap& map, const LocalizerSettings& settings)
      : map_(map), settings_(settings), features_(map, settings), map_error_(settings.map) {}

  /// Forgets what was learnt.
  void reset();

  Fits fit(const Sweep& sweep, const Expectation& expected, Timings& timings);
  /// All points from another prediction.
  ScanFit fit_from(const Sweep& sweep, const PoseWithCovariance& predicted);

  /// Learns from the residuals of the last fit, of a pose with this covariance.
  void learn(const Sweep& sweep, const Matrix3d& covariance);

  /// The scan, and what fits compare it with; views the sweep and what was learnt.
  RefinementInput input(const Sweep& sweep) const {
    return {map_, sweep.scan, sweep.scanner, map_error_.error(), sweep.motion};
  }
  const MapError& map_error() const { return map_error_.error(); }
  FitDetails details(const Sweep& sweep) const;
  /// The walls that gainsay the last fit most; see `Refiner`.
  std::span<const int> worst_walls(std::size_t most) { return refiner_.worst_walls(most); }
  const FeatureFitter& features() const { return features_; }
  void clear_features() { features_.clear(); }
  /// What each wall contributed to the last fit of all points.
  std::span<const WallShare> walls() const { return refiner_.shares(); }

 private:
  bool wants_features(const Expectation& expected) const;
  void match_features(const Sweep& sweep, const Expectation& expected, Timings& timings,
                      Fits& fits);
  void fit_points(const Sweep& sweep, const Expectation& expected, Timings& timings, Fits& fits);
  bool is_poor(const ScanFit& fit, const Expectation& expected) const;
  bool has_lost_direction(const ScanFit& fit, const Expectation& expected) const;
  void search(const Sweep& sweep, const Expectation& expected, const PoseWithCovariance& first,
              Timings& timings, Fits& fits);
  PoseWithCovariance most_likely_near(const RefinementInput& input,
                                      const PoseWithCovariance& prediction);
  const ScanFit& refine(const RefinementInput& input, const PoseWithCovariance& predicted,
                        const PoseWithCovariance& start);
  PoseWithCovariance floored_at(const PoseWithCovariance& predicted) const;

  const LineMap& map_;
  const LocalizerSettings& settings_;
  FeatureFitter features_;
  Refiner refiner_;
  MapErrorEstimator map_error_;
  FirstMapError first_map_error_;
};

}  // namespace adit
