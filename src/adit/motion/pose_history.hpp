#pragma once

#include <optional>
#include <span>
#include <vector>

#include "adit/motion/odometry.hpp"

namespace adit {

/// The last stamped poses, in order of time, and the pose at any time between them.
///
/// Keeps a fixed number of poses. A pose that is not newer than the newest is sorted into its
/// place; one with the stamp of another replaces it; one that is not finite is ignored.
class PoseHistory {
 public:
  explicit PoseHistory(std::size_t capacity = 1024);

  void add(const StampedPose& pose);
  void clear() { poses_.clear(); }
  /// Keeps only the poses whose stamps are no farther from this one.
  void keep_near(double stamp, double span_s);
  bool empty() const { return poses_.empty(); }
  std::size_t size() const { return poses_.size(); }
  /// In order of time.
  std::span<const StampedPose> poses() const { return poses_; }

  /// The pose at a time: interpolated (translation linearly, heading along the smaller turn), or
  /// the first or last pose where the time lies before or after all by no more than `max_age_s`.
  /// Absent otherwise.
  std::optional<Pose2> at(double stamp, double max_age_s) const;

  /// Whether from this stamp on, for this span, no poses are farther apart than the gap, and the
  /// span ends no farther than that from a pose.
  bool covers(double stamp, double span_s, double gap_s) const;

 private:
  std::size_t capacity_;
  std::vector<StampedPose> poses_;
};

/// Linear between two poses: `from` at 0, `to` at 1; the heading takes the smaller turn.
Pose2 interpolate(const Pose2& from, const Pose2& to, double fraction);

}  // namespace adit
