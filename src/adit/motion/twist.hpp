#pragma once

#include "adit/geometry/pose2.hpp"

namespace adit {

/// A steady motion in the vehicle's own frame: on along a circle, or a straight line.
struct Twist2 {
  double vx = 0.0;     ///< forward (m/s)
  double vy = 0.0;     ///< to the left (m/s)
  double omega = 0.0;  ///< counter-clockwise (rad/s)

  Vector2d velocity() const { return {vx, vy}; }
  Vector3d vector() const { return {vx, vy, omega}; }
  static Twist2 from_vector(const Vector3d& v) { return {v.x(), v.y(), v.z()}; }
  bool is_finite() const { return std::isfinite(vx) && std::isfinite(vy) && std::isfinite(omega); }
};

/// Chord over arc of a circle, by half the angle that it turns: sin(h) / h, 1 at 0.
inline double chord_ratio(double half_turn) {
  return half_turn == 0.0 ? 1.0 : std::sin(half_turn) / half_turn;
}

/// Where the motion arrives after so many seconds (below zero: where it was), seen from where it
/// began: the group's exponential. Exact along circles: moved(t, a) * moved(t, b) is
/// moved(t, a + b).
inline Pose2 moved(const Twist2& twist, double seconds) {
  const double turn = twist.omega * seconds;
  // The chord of the circle points along the heading halfway: no division by the turn rate.
  const double chord = seconds * chord_ratio(0.5 * turn);
  const Vector2d half = unit_vector(0.5 * turn);
  return {chord * (half.x() * twist.vx - half.y() * twist.vy),
          chord * (half.y() * twist.vx + half.x() * twist.vy), wrap_angle(turn)};
}

/// The steady motion that makes this move in so many seconds (not 0), by the smaller turn: the
/// group's logarithm, the inverse of `moved` while that turns by less than half a circle.
inline Twist2 twist_between(const Pose2& from_to, double seconds) {
  const double half_turn = 0.5 * wrap_angle(from_to.theta);
  const double rate = 1.0 / (seconds * chord_ratio(half_turn));
  const Vector2d half = unit_vector(half_turn);
  return {rate * (half.x() * from_to.x + half.y() * from_to.y),
          rate * (half.x() * from_to.y - half.y() * from_to.x), 2.0 * half_turn / seconds};
}

/// The same motion as a frame b feels it that is mounted on a: moved(result, t) is
/// inverse(a_from_b) * moved(twist_of_a, t) * a_from_b.
inline Twist2 twist_of_mounted(const Twist2& twist_of_a, const Pose2& a_from_b) {
  const Vector2d velocity =
      twist_of_a.velocity() + twist_of_a.omega * perpendicular(a_from_b.translation());
  const Vector2d turned = RigidTransform({0.0, 0.0, -a_from_b.theta}).direction(velocity);
  return {turned.x(), turned.y(), twist_of_a.omega};
}

}  // namespace adit
