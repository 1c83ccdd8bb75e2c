#pragma once

#include "adit/geometry/pose2.hpp"
#include "adit/localizer/settings.hpp"

namespace adit {

/// The covariance of a predicted pose, no smaller than the floors in any direction: the map's
/// errors that one scan sees are seen again by the next.
Matrix3d floored(const Matrix3d& covariance, const LocalizerOptions& options);

}  // namespace adit
