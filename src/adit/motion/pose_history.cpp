#include "adit/motion/pose_history.hpp"

#include <algorithm>

namespace adit {

PoseHistory::PoseHistory(std::size_t capacity) : capacity_(std::max<std::size_t>(2, capacity)) {
  poses_.reserve(capacity_ + 1);
}

void PoseHistory::add(const StampedPose& pose) {
  if (!std::isfinite(pose.stamp) || !pose.pose.is_finite()) return;
  const auto place =
      std::lower_bound(poses_.begin(), poses_.end(), pose.stamp,
                       [](const StampedPose& p, double stamp) { return p.stamp < stamp; });
  if (place != poses_.end() && place->stamp == pose.stamp) {
    *place = pose;
    return;
  }
  poses_.insert(place, pose);
  if (poses_.size() > capacity_) {
    // Half at once: the cost of moving the rest is spread over many poses.
    poses_.erase(poses_.begin(), poses_.begin() + static_cast<std::ptrdiff_t>(capacity_ / 2));
  }
}

std::optional<Pose2> PoseHistory::at(double stamp, double max_age_s) const {
  if (poses_.empty()) return std::nullopt;
  if (!(stamp <= poses_.back().stamp + max_age_s)) return std::nullopt;
  if (!(stamp >= poses_.front().stamp - max_age_s)) return std::nullopt;
  const auto after =
      std::lower_bound(poses_.begin(), poses_.end(), stamp,
                       [](const StampedPose& p, double time) { return p.stamp < time; });
  if (after == poses_.end()) return poses_.back().pose;
  if (after == poses_.begin()) return poses_.front().pose;
  const StampedPose& before = *(after - 1);
  const double fraction = (stamp - before.stamp) / (after->stamp - before.stamp);
  return interpolate(before.pose, after->pose, fraction);
}

void PoseHistory::keep_near(double stamp, double span_s) {
  std::erase_if(poses_,
                [&](const StampedPose& pose) { return !(std::abs(pose.stamp - stamp) <= span_s); });
}

bool PoseHistory::covers(double stamp, double span_s, double gap_s) const {
  const double end = stamp + span_s;
  auto next = std::upper_bound(poses_.begin(), poses_.end(), stamp,
                               [](double time, const StampedPose& p) { return time < p.stamp; });
  if (next == poses_.begin()) return false;
  for (; (next - 1)->stamp < end - gap_s; ++next) {
    if (next == poses_.end() || next->stamp - (next - 1)->stamp > gap_s) return false;
  }
  return true;
}

Pose2 interpolate(const Pose2& from, const Pose2& to, double fraction) {
  return {from.x + fraction * (to.x - from.x), from.y + fraction * (to.y - from.y),
          wrap_angle(from.theta + fraction * angle_between(from.theta, to.theta))};
}

}  // namespace adit
