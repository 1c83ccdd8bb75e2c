#pragma once

#include "counting.hpp"
#include "scene.hpp"

namespace adit {

/// Localises a drive, scan after scan, and counts its answers.
DriveCounts run_drive(const Scene& scene, std::int64_t drive);

/// How many wrong answers no scan can tell from the truth: where the truth, over all scans since
/// the fault, leads by less than 7 nats. `is_wrong[i]` says it of scan i, `believed[i]` is the
/// estimate's pose.
std::int64_t count_untold(const Scene& scene, const std::vector<Pose2>& believed,
                          const std::vector<bool>& is_wrong);

}  // namespace adit
