#pragma once

#include <filesystem>

#include "adit/geometry/result.hpp"
#include "adit/localizer/localizer.hpp"
#include "adit/simulation/vehicle.hpp"

namespace adit {

/// Fig. 4: what two places of the map see.
Result<void> draw_demo_visibility(const std::filesystem::path& folder, const LineMap& map,
                                  const LocalizerSettings& settings);

/// Figs. 5, 10, 11, 12: the corner operator, the scan and the matched features of the localizer's
/// last turn, at the estimate.
Result<void> draw_demo_turn(const std::filesystem::path& folder, const LineMap& map,
                            const Localizer& localizer, const LaserScan& scan);

/// Figs. 9 and 13: where the machine was sent, was, and was estimated to be.
Result<void> draw_demo_paths(const std::filesystem::path& folder, const LineMap& map,
                             const std::vector<Pose2>& desired,
                             const std::vector<StampedPose>& truth,
                             const std::vector<Pose2>& estimated);

}  // namespace adit
