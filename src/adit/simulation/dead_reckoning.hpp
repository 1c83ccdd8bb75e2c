#pragma once

#include "adit/motion/odometry.hpp"
#include "adit/simulation/odometry_faults.hpp"
#include "adit/simulation/random.hpp"
#include "adit/simulation/timed_path.hpp"

namespace adit {

/// An error of the declared noise: normal, with exactly `move_covariance(move, noise)`.
Vector3d draw_move_error(const Pose2& move, const OdometryNoise& noise, Random& random);

/// The move as the wheels report it: lasting errors first, then slip, then `error` added in the
/// frame of the move's start; the formula stands at `OdometryFaults`.
Pose2 reported_move(const Pose2& move, double slip_ratio, const Vector3d& error,
                    const OdometryFaults& lasting = {});

/// The path as the wheels feel it: the same moves, without the jumps; begins at the same pose.
TimedPath without_jumps(const TimedPath& path);

/// The path with a jump at `stamp`: displaced by `hop` in the vehicle's frame, steering back to the
/// old path in a straight decline over `recovery_s`.
TimedPath with_hop(const TimedPath& path, double stamp, const Pose2& hop, double recovery_s);

}  // namespace adit
