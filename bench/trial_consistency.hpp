#pragma once

#include <span>
#include <string>

#include "trial_run.hpp"

namespace adit {

/// Whether the covariances mean it: NEES and coverage over all axes and for each, in the map and in
/// the vehicle's frame, and the mean log-likelihood of the truth beside that of an oracle, the
/// empirical covariance of these very errors in the vehicle's frame. Of all answers, and of those
/// with status ok or degraded.
std::string consistency_text(std::span<const Answer> answers);

}  // namespace adit
