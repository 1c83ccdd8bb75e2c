#pragma once

#include "adit/geometry/pose2.hpp"

namespace adit {

/// A covariance over (x, y, theta) in axes that are turned by this.
inline Matrix3d turned(const Matrix3d& covariance, double by) {
  Matrix3d turn = Matrix3d::Identity();
  turn.col(0).head<2>() = unit_vector(by);
  turn.col(1).head<2>() = perpendicular(unit_vector(by));
  return turn * covariance * turn.transpose();
}

/// The pose after a move whose error is independent of the pose's: map_from_b of map_from_a and
/// a_from_b, the move's covariance in the axes of a.
inline PoseWithCovariance moved_by(const PoseWithCovariance& map_from_a,
                                   const PoseWithCovariance& a_from_b) {
  PoseWithCovariance map_from_b = carry(map_from_a, a_from_b.pose);
  map_from_b.covariance += turned(a_from_b.covariance, map_from_a.pose.theta);
  return map_from_b;
}

/// The move back: b_from_a, its covariance in the axes of b.
inline PoseWithCovariance inverse(const PoseWithCovariance& a_from_b) {
  const Pose2 back = inverse(a_from_b.pose);
  const Matrix3d& covariance = a_from_b.covariance;
  // Seen from b a turn too many swings a about b.
  Matrix3d swing = Matrix3d::Identity();
  swing.topRightCorner<2, 1>() = perpendicular(back.translation());
  return {back, swing * turned(covariance, back.theta) * swing.transpose()};
}

}  // namespace adit
