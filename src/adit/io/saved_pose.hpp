#pragma once

#include <array>
#include <string>
#include <string_view>

#include "adit/geometry/result.hpp"
#include "adit/io/json.hpp"
#include "adit/tracking/estimate.hpp"

namespace adit {

/// The last pose of a run, kept for the next: `last_pose.json`.
struct SavedPose {
  double stamp = 0.0;                      ///< s
  Pose2 pose;                              ///< map_from_vehicle
  Matrix3d covariance = Matrix3d::Zero();  ///< over (x, y, theta) in the map frame
  Status status = Status::lost;
  std::string level;  ///< of the plan; empty where it has none

  /// Whether a run may begin there: one pose, known to some extent. Of several that explained the
  /// last scans, nobody knows whether it is the one.
  bool is_known() const {
    return (status == Status::ok || status == Status::degraded) && covariance.allFinite();
  }
};

/// The covariance as files give it: xx, xy, xt, yy, yt, tt.
std::array<double, 6> upper_triangle(const Matrix3d& covariance);

/// Writes a saved pose as JSON, whole or not at all; a variance that is not finite is `null`.
Result<void> write_saved_pose(const SavedPose& saved, const std::string& path);

/// Reads what `write_saved_pose` wrote. Errors name the key and what was expected: a key is
/// missing, a number is not finite (but for the covariance's), a variance is below zero, an unknown
/// status.
Result<SavedPose> read_saved_pose(const std::string& path);

/// The same from text; `file` is the name in errors.
Result<SavedPose> parse_saved_pose(std::string_view text, const std::string& file = {});

}  // namespace adit
