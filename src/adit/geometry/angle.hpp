#pragma once

#include <cmath>
#include <numbers>

namespace adit {

inline constexpr double kPi = std::numbers::pi;
inline constexpr double kTwoPi = 2.0 * std::numbers::pi;

/// Degrees to radians.
constexpr double radians(double degrees) { return degrees * (kPi / 180.0); }

/// Radians to degrees.
constexpr double degrees(double radians) { return radians * (180.0 / kPi); }

/// The same angle in (-pi, pi]; not-a-number and infinities come back as not-a-number.
inline double wrap_angle(double angle) {
  if (angle > -kPi && angle <= kPi) return angle;
  const double wrapped = std::remainder(angle, kTwoPi);
  return wrapped <= -kPi ? kPi : wrapped;
}

/// The same angle in [0, 2 pi); not-a-number and infinities come back as not-a-number.
inline double wrap_positive(double angle) {
  const double wrapped = wrap_angle(angle);
  if (wrapped >= 0.0) return wrapped;
  const double positive = wrapped + kTwoPi;
  return positive >= kTwoPi ? 0.0 : positive;
}

/// Signed smallest turn from `from` to `to`, in (-pi, pi].
inline double angle_between(double from, double to) { return wrap_angle(to - from); }

}  // namespace adit
