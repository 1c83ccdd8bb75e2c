#pragma once

#include "adit/map/line_map.hpp"
#include "adit/refinement/beam_residuals.hpp"
#include "adit/refinement/map_error.hpp"
#include "adit/refinement/options.hpp"

namespace adit {

/// How far a wall may lie off its line where a beam meets it near a corner (m; one sigma), beside
/// the map's error: a plan that is off draws sharp what rock rounds off. Zero away from corners.
double corner_sigma(const LineMap& map, const BeamResidual& beam, const MapError& error,
                    const RefinementOptions& options);

}  // namespace adit
