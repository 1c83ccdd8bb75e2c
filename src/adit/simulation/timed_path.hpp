#pragma once

#include <span>
#include <vector>

#include "adit/motion/odometry.hpp"

namespace adit {

/// A pose for every time: between its knots by `interpolate`, at rest before the first and after
/// the last.
///
/// Knots are in order of their stamps. Two knots of one stamp are a jump; at that time the later
/// one holds.
struct TimedPath {
  std::vector<StampedPose> knots;

  Pose2 at(double stamp) const;
  double begin() const { return knots.empty() ? 0.0 : knots.front().stamp; }
  double end() const { return knots.empty() ? 0.0 : knots.back().stamp; }
};

/// The poses one after the other from time 0, each move as slow as the speed (m/s) or the turn rate
/// (rad/s) demands. Poses equal to the one before are left out.
TimedPath drive_along(std::span<const Pose2> poses, double speed, double turn_rate);

}  // namespace adit
