#pragma once

#include <Eigen/Core>

#include "adit/geometry/angle.hpp"

namespace adit {

using Eigen::Matrix2d;
using Eigen::Matrix3d;
using Eigen::Vector2d;
using Eigen::Vector3d;

/// z component of the cross product: positive when b lies counter-clockwise of a.
inline double cross(const Vector2d& a, const Vector2d& b) { return a.x() * b.y() - a.y() * b.x(); }

/// The vector turned by +90 degrees.
inline Vector2d perpendicular(const Vector2d& v) { return {-v.y(), v.x()}; }

/// Unit vector at an angle (rad).
inline Vector2d unit_vector(double angle) { return {std::cos(angle), std::sin(angle)}; }

/// A rigid motion of the plane: `map_from_vehicle * point_in_vehicle` is the point in the map.
///
/// Metres and radians, theta counter-clockwise in (-pi, pi]. Poses form a group under `*` with
/// `inverse` and the identity `Pose2{}`; inner frames cancel: a_from_b * b_from_c is a_from_c.
struct Pose2 {
  double x = 0.0;
  double y = 0.0;
  double theta = 0.0;

  Vector2d translation() const { return {x, y}; }
  Vector3d vector() const { return {x, y, theta}; }
  static Pose2 from_vector(const Vector3d& v) { return {v.x(), v.y(), wrap_angle(v.z())}; }
  bool is_finite() const { return std::isfinite(x) && std::isfinite(y) && std::isfinite(theta); }
};

/// A point carried by a pose. For many points use `RigidTransform`, which keeps sine and cosine.
inline Vector2d operator*(const Pose2& a_from_b, const Vector2d& point_in_b) {
  const double c = std::cos(a_from_b.theta);
  const double s = std::sin(a_from_b.theta);
  return {a_from_b.x + c * point_in_b.x() - s * point_in_b.y(),
          a_from_b.y + s * point_in_b.x() + c * point_in_b.y()};
}

/// Composition; theta is wrapped.
inline Pose2 operator*(const Pose2& a_from_b, const Pose2& b_from_c) {
  const Vector2d t = a_from_b * b_from_c.translation();
  return {t.x(), t.y(), wrap_angle(a_from_b.theta + b_from_c.theta)};
}

/// b_from_a of a_from_b.
inline Pose2 inverse(const Pose2& a_from_b) {
  const double c = std::cos(a_from_b.theta);
  const double s = std::sin(a_from_b.theta);
  return {-c * a_from_b.x - s * a_from_b.y, s * a_from_b.x - c * a_from_b.y,
          wrap_angle(-a_from_b.theta)};
}

/// From one pose to another of the same frame: x, y and the smaller turn.
inline Vector3d difference(const Pose2& from, const Pose2& to) {
  return {to.x - from.x, to.y - from.y, angle_between(from.theta, to.theta)};
}

/// Whether two poses are no farther apart than this (m) and no more turned (rad).
inline bool is_near(const Pose2& a, const Pose2& b, double metres, double radians) {
  const Vector3d apart = difference(a, b);
  return apart.head<2>().norm() <= metres && std::abs(apart.z()) <= radians;
}

/// The pose with its axes, for carrying many points and directions.
struct RigidTransform {
  explicit RigidTransform(const Pose2& pose)
      : RigidTransform(pose.translation(), unit_vector(pose.theta)) {}
  RigidTransform(const Vector2d& from, const Vector2d& x)
      : origin(from), axis_x(x), axis_y(-x.y(), x.x()) {}

  Vector2d direction(const Vector2d& v) const { return axis_x * v.x() + axis_y * v.y(); }
  Vector2d point(const Vector2d& p) const { return origin + direction(p); }
  /// `b` as this one's frame sees it.
  RigidTransform operator*(const RigidTransform& b) const {
    return {point(b.origin), direction(b.axis_x)};
  }

  Vector2d origin;
  Vector2d axis_x;
  Vector2d axis_y;
};

/// A pose in the map and its covariance over (x, y, theta) in the map frame (m, m, rad).
struct PoseWithCovariance {
  Pose2 pose;
  Matrix3d covariance = Matrix3d::Zero();
};

/// The pose of a rigidly mounted frame and its covariance, with the lever arm's part of it:
/// map_from_b of map_from_a and the fixed a_from_b.
inline PoseWithCovariance carry(const PoseWithCovariance& map_from_a, const Pose2& a_from_b) {
  const Vector2d lever = RigidTransform(map_from_a.pose).direction(a_from_b.translation());
  Matrix3d jacobian = Matrix3d::Identity();
  jacobian(0, 2) = -lever.y();
  jacobian(1, 2) = lever.x();
  return {map_from_a.pose * a_from_b, jacobian * map_from_a.covariance * jacobian.transpose()};
}

}  // namespace adit
