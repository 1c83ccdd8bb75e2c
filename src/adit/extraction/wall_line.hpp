#pragma once

#include <optional>

#include "adit/extraction/corner_operator.hpp"
#include "adit/features/features.hpp"

namespace adit {

/// The maximum-likelihood line of a stretch under range noise along the beams, in the laser's
/// frame.
///
/// Gauss-Newton on the ranges (Pfister et al. 2003 weigh likewise), started from the orthogonal
/// regression; points beyond `gate` sigmas are left out of the second step. The covariance follows
/// from the noise of the points and is scaled up where they scatter more than that. Absent where
/// fewer than `min_points` points are left.
std::optional<Line> fit_wall_line(const ScanPoints& points, Stretch stretch, int min_points,
                                  double gate = 3.5);

/// Where the beam of unit direction `beam` meets the infinite line; the nearest point of the line
/// to `fallback` where they are nearly parallel.
Vector2d meet(const Line& line, const Vector2d& beam, const Vector2d& fallback);

}  // namespace adit
