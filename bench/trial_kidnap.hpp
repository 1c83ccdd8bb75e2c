#pragma once

#include <optional>

#include "trial_run.hpp"

namespace adit {

/// A run in which the vehicle is suddenly elsewhere on the path, in a place whose scan contradicts
/// the one believed, while odometry goes on as if nothing had happened. The scans from there on are
/// marked as affected. Nothing where no such place was found.
std::optional<TrialRun> kidnapped_run(TrialScene scene, std::uint64_t seed);

/// A run from a random place of the path that is started in a wrong one.
std::optional<TrialRun> wrongly_started_run(TrialScene scene, std::uint64_t seed);

/// A start 3 to 8 m away with any heading that claims to be sure, which the scan at the truth
/// contradicts; nothing where none was found.
std::optional<PoseWithCovariance> draw_wrong_start(const TrialScene& scene, const LineMap& map,
                                                   const Pose2& truth, Random& random);

}  // namespace adit
