#pragma once

#include "adit/geometry/pose2.hpp"
#include "adit/scan/laser_scan.hpp"

namespace adit {

/// A scan and where the vehicle stood: what a survey of a drive ends with and what walls are made
/// from. The laser's own pose is `map_from_vehicle * scan.vehicle_from_laser`.
struct PosedScan {
  LaserScan scan;
  Pose2 map_from_vehicle;
  Matrix3d covariance = Matrix3d::Zero();  ///< of the pose, over (x, y, theta) in the map (m, rad)
};

}  // namespace adit
