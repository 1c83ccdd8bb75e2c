#pragma once

#include <cstddef>

#include "adit/geometry/pose2.hpp"
#include "adit/refinement/beam_priors.hpp"

namespace adit {

/// What a beam may meet, as index into the vectors and matrices of the chain.
struct Met {
  static constexpr Eigen::Index kWall = 0;
  static constexpr Eigen::Index kOther = 1;
  static constexpr Eigen::Index kBeyond = 2;  ///< a wall of the map behind one that is gone
};

/// Probabilities of what the beam after `beams` more meets (column), by what this one met (row).
///
/// What stands in the way, and a gap where a wall is gone, cover a run of neighbouring beams. A
/// proper chain for any priors within [0, 1].
Matrix3d transition(const BeamPriors& priors, std::size_t beams = 1);

/// Probabilities of what any beam meets, of which nothing is known: `transition` keeps them.
Vector3d steady_state(const BeamPriors& priors);

}  // namespace adit
