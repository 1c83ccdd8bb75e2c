#pragma once

#include <algorithm>

#include "adit/geometry/pose2.hpp"
#include "adit/refinement/map_error.hpp"

namespace adit {

/// The offset of the walls from the map's lines as a sweep meets it, point by point: a stationary
/// Markov process, so that a Kalman filter along the sweep is exact.
struct OffsetProcess {
  double variance = 1.0;  ///< of the offset at any point (m², or 1 where it is told in sigmas)
  double length_m = 1.0;  ///< along a wall, within which the correlation falls to about 1/e

  /// How much of the offset one point shares with the next, both with the normal of their wall
  /// towards the scanner: none across a corner, all of it along a wall or a smooth bend.
  double correlation(const Vector2d& from_hit, const Vector2d& from_normal, const Vector2d& to_hit,
                     const Vector2d& to_normal) const {
    const double lengths = (to_hit - from_hit).norm() / std::max(length_m, 1e-3);
    const double bend = std::max(0.0, to_normal.dot(from_normal));
    // 1 / (1 + x + x²/2) for exp(-x): any correlation within [0, 1] makes a proper process.
    return bend / (1.0 + lengths * (1.0 + 0.5 * lengths));
  }

  /// Variance at the next point, of an offset that is known to `known` at this one.
  double carried(double known, double correlation) const {
    return variance + correlation * correlation * (known - variance);
  }
};

/// That of a map which errs so.
inline OffsetProcess offset_process(const MapError& error) {
  return {error.offset_sigma_m * error.offset_sigma_m, error.length_m};
}

}  // namespace adit
