#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "adit/survey/drive_options.hpp"
#include "adit/survey/pose_graph.hpp"
#include "adit/survey/scan_tracker.hpp"

namespace adit {

/// One constraint for each pair of keyframes that see the same walls, at these poses.
std::vector<PoseConstraint> register_pairs(std::span<const Keyframe> keyframes,
                                           std::span<const Pose2> poses,
                                           std::span<const PoseConstraint> backbone,
                                           const JointOptions& options,
                                           const AlignmentOptions& alignment, int threads);

}  // namespace adit
