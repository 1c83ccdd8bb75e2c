#pragma once

#include <string>
#include <vector>

#include "adit/io/estimates.hpp"
#include "adit/motion/odometry.hpp"

namespace adit {

/// The paper's Tables I and II with this run's columns beside them, and the errors of both.
std::string demo_tables(const std::vector<StampedPose>& truth,
                        const std::vector<EstimateRow>& rows);

}  // namespace adit
