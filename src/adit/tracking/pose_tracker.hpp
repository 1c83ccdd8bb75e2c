#pragma once

#include <Eigen/Core>

#include "adit/geometry/pose2.hpp"
#include "adit/motion/odometry.hpp"

namespace adit {

/// How scans and dead reckoning are fused.
struct TrackingOptions {
  double bias_distance_m = 40.0;
  double bias_lever_m = 2.0;
  double gate_chi_square = 16.27;

  template <class Self, class Field>
  static void visit(Self& self, Field&& field) {
    field("bias_distance_m", self.bias_distance_m,
          "way after which the plan's errors have become others, to 1/e (m)");
    field("bias_lever_m", self.bias_lever_m, "a turn by one radian counts as so much way (m)");
    field("gate_chi_square", self.gate_chi_square,
          "a scan farther than this from dead reckoning says that the wheels slipped: the "
          "prediction counts as less sure; chi-square of three degrees of freedom at 1e-3");
  }
};

/// What a scan says of the pose: log likelihood score^T d - d^T information d / 2 at a pose that
/// lies d from `pose` (x, y, theta; map frame). Directions without information are not observed.
struct PoseObservation {
  Pose2 pose;
  Vector3d score = Vector3d::Zero();
  Matrix3d information = Matrix3d::Zero();
  /// The same if the map's errors were known, so that only noise is left; at least `information`.
  Matrix3d noise_information = Matrix3d::Zero();
};

/// Covariance of the pose that an observation gives alone; very large where it sees nothing.
Matrix3d fix_covariance(const Matrix3d& information);

/// Of a pose of which nothing is known.
Matrix3d unknown_covariance();

/// A filter over the pose that does not take the map's errors for noise.
///
/// The plan's errors that one scan sees are seen again by the next, from almost the same place. A
/// filter that takes fixes as independent averages them away, and lies. The covariance of the pose
/// is kept in two parts: noise, which is independent of the next scan's, and bias, which may be the
/// very error that the next scan has (split covariance intersection, Julier and Uhlmann 2001). Bias
/// becomes noise with the way, as other walls come into sight.
class PoseTracker {
 public:
  void start(const PoseWithCovariance& map_from_vehicle);

  /// Dead reckoning: a move in the vehicle's frame, and how wrong it may be.
  void predict(const Pose2& move, const OdometryNoise& noise, const TrackingOptions& options);

  /// Chi-square of three degrees of freedom of what a scan says against the prediction.
  double chi_square(const PoseObservation& observation) const;

  /// Takes in what a scan says. Returns its chi-square of three degrees of freedom against the
  /// prediction; beyond the gate the prediction is made unsure until they agree.
  double update(const PoseObservation& observation, const TrackingOptions& options);

  /// Time without any dead reckoning: the pose may have moved by this, in any direction.
  void blur(double metres, double radians);

  const PoseWithCovariance& estimate() const { return estimate_; }

 private:
  Vector3d innovation_of(const PoseObservation& observation) const;

  PoseWithCovariance estimate_;
  Matrix3d bias_ = Matrix3d::Zero();  // the part of the covariance that the map's errors may be
};

}  // namespace adit
