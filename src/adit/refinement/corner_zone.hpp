#pragma once

#include <algorithm>
#include <cmath>

#include "adit/map/line_map.hpp"
#include "adit/refinement/beam_residuals.hpp"
#include "adit/refinement/map_error.hpp"
#include "adit/refinement/options.hpp"

namespace adit {

/// Whether the wall turns at one of its vertices; where it ends or goes straight on it does not.
bool is_corner(const LineMap& map, int wall, int vertex);

/// How far a wall may lie off its line where a beam meets it near a corner (m; one sigma), beside
/// the map's error: a plan that is off draws sharp what rock rounds off. Zero away from corners.
inline double corner_sigma(const LineMap& map, const BeamResidual& beam, const MapError& error,
                           const RefinementOptions& options) {
  const double zone = options.corner_reach_ratio * error.offset_sigma_m;
  const Wall& wall = map.walls()[static_cast<std::size_t>(beam.wall)];
  const double to_a = (beam.hit - wall.segment.a).squaredNorm();
  const double to_b = (beam.hit - wall.segment.b).squaredNorm();
  const double nearest = std::min(to_a, to_b);
  if (nearest >= zone * zone) return 0.0;
  if (!is_corner(map, beam.wall, to_a < to_b ? wall.vertex_a : wall.vertex_b)) return 0.0;
  return options.corner_sigma_ratio * error.offset_sigma_m * (1.0 - std::sqrt(nearest) / zone);
}

}  // namespace adit
