#pragma once

#include "adit/simulation/vehicle.hpp"

namespace adit {

/// The second recording after the first, as if the machine had been carried from the end of the one
/// to the beginning of the other between two scans. Of that its odometry and gyro show the move
/// `shown`: none, or what it may have driven in that time.
Recording carried_off(Recording first, const Recording& second, const Pose2& shown = {});

/// The last move that the odometry shows from scan to scan; none where there is but one scan.
Pose2 last_move(const Recording& recording);

}  // namespace adit
