#pragma once

#include "adit/geometry/pose2.hpp"

namespace adit {

/// A pose and the time at which it held (s).
struct StampedPose {
  double stamp = 0.0;
  Pose2 pose;
};

/// How wrong dead reckoning may be: one sigma of a move between two scans, linear in the move.
///
/// Sigma of the translation is `translation_sigma_ratio` * metres moved; sigma of the rotation is
/// `rotation_sigma_rad_per_m` * metres + `rotation_sigma_ratio` * radians turned, plus the floors,
/// which stand for the resolution of the counters and for hops while the machine stands.
struct OdometryNoise {
  double translation_sigma_ratio = 0.10;
  double rotation_sigma_rad_per_m = 0.02;
  double rotation_sigma_ratio = 0.10;
  double translation_floor_m = 0.003;
  double rotation_floor_rad = 0.0015;

  template <class Self, class Field>
  static void visit(Self& self, Field&& field) {
    field("translation_sigma_ratio", self.translation_sigma_ratio,
          "sigma of the translation per metre moved; loose default of a tracked machine");
    field("rotation_sigma_rad_per_m", self.rotation_sigma_rad_per_m,
          "sigma of the rotation per metre moved (rad/m); loose default of a tracked machine");
    field("rotation_sigma_ratio", self.rotation_sigma_ratio,
          "sigma of the rotation per radian turned; loose default of a tracked machine");
    field("translation_floor_m", self.translation_floor_m,
          "sigma of the translation of a machine that reports no move (m)");
    field("rotation_floor_rad", self.rotation_floor_rad,
          "sigma of the rotation of a machine that reports no move (rad)");
  }
};

/// Covariance over (x, y, theta) in the frame of the move's start, for a move `from_to`.
Matrix3d move_covariance(const Pose2& from_to, const OdometryNoise& noise);

/// Dead reckoning: the pose after the move, its covariance carried to first order and grown.
/// The result's covariance is over (x, y, theta) in the map frame.
PoseWithCovariance dead_reckon(const PoseWithCovariance& map_from_vehicle, const Pose2& move,
                               const OdometryNoise& noise);

}  // namespace adit
