#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "adit/geometry/pose2.hpp"
#include "adit/scan/scanner_model.hpp"

namespace adit {

/// The same as `beam_variance`, where 1 / cos² beta is at hand.
inline double beam_variance_stretched(const ScannerModel& scanner, double range,
                                      double stretch_squared, double map_sigma_m) {
  const double tan_squared = std::max(0.0, stretch_squared - 1.0);
  const double beside = range * scanner.bearing_sigma_rad;
  return scanner.range_sigma_m * scanner.range_sigma_m +
         scanner.quantisation_m * scanner.quantisation_m / 12.0 +
         map_sigma_m * map_sigma_m * stretch_squared + beside * beside * tan_squared;
}

/// Variance (m²) of measured minus predicted range for one beam that meets a wall at incidence
/// beta.
///
/// The sum of the range noise, the rounding to `quantisation_m` (uniform, hence a twelfth of its
/// square), a wall that lies `map_sigma_m` off its line, which the beam sees stretched by 1 / cos
/// beta, and a beam that points beside its bearing. `cos_incidence` is |n . d| of the wall's unit
/// normal and the beam's direction; infinity where it is zero: a wall seen edge-on tells nothing.
inline double beam_variance(const ScannerModel& scanner, double range, double cos_incidence,
                            double map_sigma_m) {
  const double cos_squared = cos_incidence * cos_incidence;
  if (!(cos_squared > 0.0)) return std::numeric_limits<double>::infinity();
  return beam_variance_stretched(scanner, range, 1.0 / cos_squared, map_sigma_m);
}

/// Derivative of the predicted range with respect to (x, y, theta) in the map of the vehicle that
/// carries the laser, or of the laser itself where there is no lever arm.
///
/// `direction` is the beam's unit vector and `normal` the wall's unit normal (either sign), both in
/// map axes: -(n_x, n_y, r n . d_perp + n . l_perp) / (n . d), Censi 2007. `lever_arm` l is the
/// laser's position relative to the vehicle's, in map axes (m): turning the vehicle also moves the
/// laser sideways. Not finite for a wall seen edge-on.
inline Vector3d range_gradient(double range, const Vector2d& direction, const Vector2d& normal,
                               const Vector2d& lever_arm = Vector2d::Zero()) {
  const double across = range * cross(direction, normal) + cross(lever_arm, normal);
  return Vector3d(normal.x(), normal.y(), across) / -normal.dot(direction);
}

}  // namespace adit
