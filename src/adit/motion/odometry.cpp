#include "adit/motion/odometry.hpp"

#include "adit/geometry/uncertain_move.hpp"

namespace adit {

Matrix3d move_covariance(const Pose2& from_to, const OdometryNoise& noise) {
  const double metres = from_to.translation().norm();
  const double translation = noise.translation_sigma_ratio * metres + noise.translation_floor_m;
  const double rotation = noise.rotation_sigma_rad_per_m * metres +
                          noise.rotation_sigma_ratio * std::abs(from_to.theta) +
                          noise.rotation_floor_rad;
  // The heading errs somewhere along the way: half of it acts on the translation (trapezium rule).
  Matrix3d from_error = Matrix3d::Identity();
  from_error(0, 2) = -0.5 * from_to.y;
  from_error(1, 2) = 0.5 * from_to.x;
  const Vector3d variance(translation * translation, translation * translation,
                          rotation * rotation);
  return from_error * variance.asDiagonal() * from_error.transpose();
}

PoseWithCovariance dead_reckon(const PoseWithCovariance& map_from_vehicle, const Pose2& move,
                               const OdometryNoise& noise) {
  return moved_by(map_from_vehicle, {move, move_covariance(move, noise)});
}

}  // namespace adit
