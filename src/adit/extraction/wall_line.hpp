#pragma once

#include <optional>

#include "adit/extraction/corner_operator.hpp"
#include "adit/features/features.hpp"

namespace adit {

/// Which ends of a stretch are cuts inside a piece, where the noise decided what belongs to it.
struct CutEnds {
  bool begin = false;
  bool end = false;
};

/// The maximum-likelihood line of a stretch under range noise along the beams, in the laser's
/// frame.
///
/// A Gauss-Newton step on the ranges (Pfister et al. 2003 weigh likewise) from the orthogonal
/// regression; points beyond `gate` sigmas are left out. The covariance follows
/// from the noise of the points and is scaled up where they scatter more than that. Absent where
/// fewer than `min_points` points are left.
std::optional<Line> fit_wall_line(const ScanPoints& points, ScanStretch stretch, int min_points,
                                  const CutEnds& cuts = {}, double gate = 3.5);

/// Where the beam of unit direction `beam` meets the infinite line; the nearest point of the line
/// to `fallback` where they are nearly parallel.
Vector2d meet(const Line& line, const Vector2d& beam, const Vector2d& fallback);

}  // namespace adit
