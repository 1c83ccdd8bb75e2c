#pragma once

#include <vector>

#include "adit/localizer/belief.hpp"
#include "adit/localizer/fitter.hpp"
#include "adit/localizer/settings.hpp"
#include "adit/refinement/displacement.hpp"
#include "adit/tracking/estimate.hpp"
#include "adit/tracking/protection.hpp"

namespace adit {

/// Says of what is believed how sure it is and whether to trust it: status, covariance, protection
/// level. Remembers what walls that may be wrong have done to the pose.
class Judge {
 public:
  /// The settings must outlive it.
  explicit Judge(const LocalizerSettings& settings) : settings_(settings) {}

  /// Forgets all walls: the pose is another's.
  void forget();
  /// The vehicle has gone on by so much (m).
  void drive(double way_m) { displacement_.drive(way_m, settings_.displacement); }

  /// The estimate by dead reckoning alone: the scan could not be used.
  Estimate without_scan(double stamp, const Believed& believed) const;
  Estimate judge(double stamp, const Believed& believed, const Fits& fits,
                 const FitDetails& details);

 private:
  bool uses_points() const { return settings_.estimator != Estimator::features; }
  Matrix3d plan_error() const;
  double protection_radius(const Believed& believed, const Fits& fits, const FitDetails& details);

  const LocalizerSettings& settings_;
  Protection protection_;
  RecentDisplacement displacement_;
  std::vector<WallEvidence> walls_;
};

}  // namespace adit
