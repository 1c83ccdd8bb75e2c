#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "adit/geometry/pose2.hpp"
#include "adit/map/line_map.hpp"
#include "adit/scan/laser_scan.hpp"
#include "adit/scan/scanner_model.hpp"
#include "adit/visibility/visibility.hpp"

namespace adit {

/// The beams of a scanner and its mounting: beam i points at `first_bearing` + i `bearing_step`
/// (rad, laser frame). The default is 1000 beams around the full circle.
struct BeamFan {
  double first_bearing = -kPi;
  double bearing_step = kTwoPi / 1000.0;
  int count = 1000;
  Pose2 vehicle_from_laser;
};

/// The fan with which a scan was taken.
BeamFan beam_fan(const LaserScan& scan);

/// What counts as information in the bound.
struct BoundOptions {
  double map_sigma_m = 0.0;
  double max_incidence_rad = radians(89.0);
  bool use_edge_beams = true;

  template <class Self, class Field>
  static void visit(Self& self, Field&& field) {
    field("map_sigma_m", self.map_sigma_m,
          "how far a wall may lie from its line, independently for each beam, one sigma (m); 0 is "
          "the perfect map");
    field(
        "max_incidence_rad", self.max_incidence_rad,
        "beams that meet a wall flatter than this (rad from its normal) tell nothing; in the last "
        "degree rock returns no echo and the range is no longer linear in the pose");
    field(
        "use_edge_beams", self.use_edge_beams,
        "count the beams beside a depth edge as well; without them the bound is what an estimator "
        "reaches that discards beams which may fall on either side");
  }
};

/// What one scan can tell about the pose of the vehicle, over (x, y, theta) in the map frame.
struct PoseBound {
  Matrix3d information = Matrix3d::Zero();  ///< sum of g g^T / variance
  int rank = 0;                             ///< directions of the pose that the scan observes
  std::optional<Matrix3d> covariance;       ///< inverse of the information; none below rank 3
  std::int64_t beams = 0;                   ///< that entered the sum
  std::int64_t edge_beams = 0;              ///< that lie beside a depth edge, used or not
};

/// Buffers of `cramer_rao`, reused from call to call.
struct BoundWorkspace {
  Visibility visibility;
  std::vector<double> ranges;
  std::vector<int> walls;
};

/// How many directions the information matrix observes, and its inverse if it observes all three.
///
/// Judged after scaling each axis to unit information, so that metres and radians do not matter.
int information_rank(const Matrix3d& information, std::optional<Matrix3d>* inverse = nullptr);

/// The Cramér-Rao bound: no unbiased estimator from one scan at this pose has a covariance below
/// the inverse of the information (Censi, ICRA 2007).
///
/// The predicted range is smooth only between the depth edges: as in Censi's derivation the jumps
/// themselves count for nothing, and each beam counts with the gradient on the wall that it hits.
/// Likewise a beam without return, which says that rock is far. Rounding counts as noise, so
/// the bound holds for steps up to about twice the noise.
PoseBound cramer_rao(const LineMap& map, const Pose2& map_from_vehicle, const ScannerModel& scanner,
                     const BeamFan& fan, const BoundOptions& options, BoundWorkspace& workspace);

}  // namespace adit
