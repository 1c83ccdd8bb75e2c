#pragma once

#include <span>

#include "adit/scan_motion/options.hpp"
#include "adit/scan_motion/surface_map.hpp"

namespace adit {

/// What is known of a pose beforehand.
struct PosePrior {
  Pose2 pose;
  Matrix3d information = Matrix3d::Zero();
};

/// Where points lie on others.
struct Alignment {
  Pose2 target_from_source;
  /// Of the points alone, over (x, y, theta) of the pose in the target's frame.
  Matrix3d information = Matrix3d::Zero();
  int matched = 0;             ///< points that found a wall at the end
  double matched_share = 0.0;  ///< of those with a normal
  double closeness = 0.0;      ///< the mean over those at the end, as in `Linearization`
};

/// Robust point-to-line alignment (Chen and Medioni 1991) by Gauss-Newton with the weights of
/// Geman and McClure; a wall counts only for points that face as it does.
Alignment align(std::span<const SurfacePoint> source, const SurfaceMap& target,
                const PosePrior& prior, const Pose2& start, double beam_sigma_m,
                const AlignmentOptions& options);

/// One step's worth of the same: the normal equations at a pose, for joint solutions.
struct Linearization {
  Matrix3d information = Matrix3d::Zero();
  Vector3d gradient = Vector3d::Zero();
  int matched = 0;
  int tried = 0;
  double closeness = 0.0;  ///< sum over the points: 1 on its wall, 0.5 at the scale, 0 without one
  /// The mean over the points with a normal, 0 to 1; 0 where there are none.
  double mean_closeness() const { return tried > 0 ? closeness / tried : 0.0; }
};

/// Takes out what walls seem to say of a direction in which they do not hold the pose (after Zhang,
/// Kaess and Singh 2016).
void drop_weak_direction(Linearization& lin, const AlignmentOptions& options);

Linearization linearize(std::span<const SurfacePoint> source, const SurfaceMap& target,
                        const Pose2& target_from_source, double reach_m, double scale_m);

}  // namespace adit
