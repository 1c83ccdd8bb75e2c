#pragma once

#include <limits>
#include <optional>
#include <span>

#include "adit/features/features.hpp"
#include "adit/geometry/pose2.hpp"

namespace adit {

/// May the pose be trusted?
enum class Status {
  ok,         ///< the scan agrees with the pose; what it does not show is dead reckoning
  degraded,   ///< a direction of the pose comes from dead reckoning alone
  ambiguous,  ///< more than one pose explains the scan
  lost,       ///< no pose near the prediction explains the scan: the pose is dead reckoning
};

/// "ok", "degraded", "ambiguous", "lost".
const char* to_string(Status status);

/// Where the vehicle is at the stamp of a scan, how sure that is, and whether to trust it.
struct Estimate {
  double stamp = 0.0;
  Pose2 pose;                              ///< map_from_vehicle
  Matrix3d covariance = Matrix3d::Zero();  ///< over (x, y, theta) in the map frame
  Status status = Status::lost;
  bool dead_reckoned = true;  ///< the scan did not contribute
  double protection_m = std::numeric_limits<double>::infinity();
  /// The direction (unit vector, map axes) that the scan does not show; none where it shows all.
  std::optional<Vector2d> open_direction;
  double chi_square = 0.0;  ///< of the fit, with `degrees_of_freedom`
  int degrees_of_freedom = 0;
  std::span<const FeaturePair> pairs;  ///< matched features; views the localizer's buffers
};

}  // namespace adit
