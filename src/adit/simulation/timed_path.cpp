#include "adit/simulation/timed_path.hpp"

#include <algorithm>
#include <cmath>

#include "adit/motion/pose_history.hpp"

namespace adit {

Pose2 TimedPath::at(double stamp) const {
  if (knots.empty()) return {};
  const auto after =
      std::upper_bound(knots.begin(), knots.end(), stamp,
                       [](double t, const StampedPose& knot) { return t < knot.stamp; });
  if (after == knots.begin()) return knots.front().pose;
  if (after == knots.end()) return knots.back().pose;
  const StampedPose& before = *(after - 1);
  return interpolate(before.pose, after->pose,
                     (stamp - before.stamp) / (after->stamp - before.stamp));
}

TimedPath drive_along(std::span<const Pose2> poses, double speed, double turn_rate) {
  TimedPath path;
  for (const Pose2& pose : poses) {
    if (path.knots.empty()) {
      path.knots.push_back({0.0, pose});
      continue;
    }
    const StampedPose& last = path.knots.back();
    const double metres = (pose.translation() - last.pose.translation()).norm();
    const double turn = std::abs(angle_between(last.pose.theta, pose.theta));
    const double seconds = std::max(metres / speed, turn / turn_rate);
    if (seconds > 0.0) path.knots.push_back({last.stamp + seconds, pose});
  }
  return path;
}

}  // namespace adit
