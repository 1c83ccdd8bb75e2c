#pragma once

#include <span>
#include <vector>

#include "adit/geometry/pose2.hpp"

namespace adit {

/// What one wall of the plan says of the pose, as normal equations at the pose of the fit.
struct WallEvidence {
  int wall = -1;
  Matrix3d information = Matrix3d::Zero();
  Vector3d score = Vector3d::Zero();
};

/// How the protection level is made.
struct ProtectionOptions {
  double risk = 1e-3;
  double margin = 1.3;
  double loose_prior = 9.0;

  template <class Self, class Field>
  static void visit(Self& self, Field&& field) {
    field("risk", self.risk,
          "probability that the position errs by more than the protection level");
    field("margin", self.margin,
          "factor on what the covariances of filter and fits say, but for the plan's long error");
    field(
        "loose_prior", self.loose_prior,
        "where one wall is left out, dead reckoning's variance counts so many times: without that "
        "wall it would be less sure");
  }
};

/// Radius (m) that the position's error exceeds with probability `risk`, if it is normal with this
/// covariance.
double radius_of(const Matrix3d& covariance, double risk);

/// The protection level (m) of a tracked pose: a radius that the position's error exceeds with
/// probability `risk` at most, over the hypotheses that nothing of the plan is wrong, or any one
/// wall of it.
///
/// Solution separation (Brown and McBurney 1988, for satellites): without the wall that is wrong
/// the fit is right, so the error is at most the distance to it plus that fit's own. The prediction
/// has followed that wall before; where it would be without is remembered, wall by wall.
class Protection {
 public:
  Protection();

  /// The level after a scan. `walls` are its evidence about the pose `fitted_at`; `plan_error` is
  /// what the plan errs as a whole around here (x, y, theta; map axes), in no other covariance.
  double update(const PoseWithCovariance& estimate, const PoseWithCovariance& prediction,
                const Pose2& fitted_at, std::span<const WallEvidence> walls,
                const Matrix3d& plan_error, const ProtectionOptions& options);
  /// Forgets all walls: the pose is another's.
  void reset() { followed_.clear(); }

 private:
  /// From the estimate to where the vehicle is if this wall is wrong (x, y, theta; map axes).
  struct Followed {
    int wall = -1;
    Vector3d separation = Vector3d::Zero();
    bool in_sight = false;
  };
  Vector3d take(int wall);
  void keep(int wall, const Vector3d& separation);

  std::vector<Followed> followed_;
  std::vector<Followed> before_;  // the last scan's
};

}  // namespace adit
