#pragma once

#include <cstdint>
#include <limits>
#include <span>

#include "adit/information/bound.hpp"
#include "adit/motion/odometry.hpp"

namespace adit {

/// The errors that the best unbiased estimator from single scans would show along a drive.
///
/// Means and root mean squares over the poses whose scan observes all three directions, each of the
/// normal distribution that the Cramér-Rao bound gives there; comparable with `Statistics` of the
/// same poses. Not-a-number where no pose is observable.
struct BoundSummary {
  static constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  std::int64_t count = 0;
  std::int64_t unobservable = 0;  ///< poses left out
  double position_mean = kNone;   ///< m
  double position_rms = kNone;
  double heading_mean_deg = kNone;
  double heading_rms_deg = kNone;
};

/// Sums the bound up over `poses` (map_from_vehicle).
BoundSummary bound_along(const LineMap& map, std::span<const StampedPose> poses,
                         const ScannerModel& scanner, const BeamFan& fan,
                         const BoundOptions& options = {});

/// Mean length of a two-dimensional normal error of mean zero with this covariance.
double mean_error_length(const Matrix2d& covariance);

}  // namespace adit
