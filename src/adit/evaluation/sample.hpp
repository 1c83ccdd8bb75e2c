#pragma once

#include <optional>
#include <span>
#include <vector>

#include "adit/geometry/pose2.hpp"
#include "adit/motion/odometry.hpp"
#include "adit/tracking/estimate.hpp"

namespace adit {

/// One row to be judged: a pose of the vehicle in the map, and what else the estimator said of it.
struct EstimateSample {
  double stamp = 0.0;
  Pose2 pose;
  std::optional<Matrix3d> covariance;  ///< over (x, y, theta) in the map frame; inf is unknown
  std::optional<Status> status;
  std::optional<double> protection_m;
};

/// The rows of a bare trajectory: poses alone.
std::vector<EstimateSample> samples_of(std::span<const StampedPose> trajectory);

/// The rows of an estimator's answers.
std::vector<EstimateSample> samples_of(std::span<const Estimate> estimates);

}  // namespace adit
