#pragma once

#include <vector>

#include "adit/extraction/scan_points.hpp"
#include "adit/geometry/pose2.hpp"
#include "adit/scan/laser_scan.hpp"
#include "adit/scan/scanner_model.hpp"
#include "adit/scan_motion/options.hpp"

namespace adit {

/// A point on a wall and the way in which the wall faces: unit, towards the scanner that saw it.
/// The normal is zero where the point's neighbours do not show it.
struct SurfacePoint {
  Eigen::Vector2f point = Eigen::Vector2f::Zero();
  Eigen::Vector2f normal = Eigen::Vector2f::Zero();

  bool has_normal() const { return normal.x() != 0.0F || normal.y() != 0.0F; }
};

/// The same point seen from another frame.
inline SurfacePoint carry(const RigidTransform& a_from_b, const SurfacePoint& p) {
  return {a_from_b.point(p.point.cast<double>()).cast<float>(),
          a_from_b.direction(p.normal.cast<double>()).cast<float>()};
}

/// A scan as points of walls, and where it was taken from, in the vehicle's frame.
struct ScanShape {
  std::vector<SurfacePoint> points;
  Eigen::Vector2f eye = Eigen::Vector2f::Zero();
};

/// Makes shapes of scans; keeps its buffers from one to the next.
class SurfaceMaker {
 public:
  ScanShape shape(const LaserScan& scan, const ScannerModel& scanner,
                  const SurfaceOptions& options);

 private:
  SurfacePoint surface_at(std::size_t i, const ScanPoints::Piece& piece, double sigma,
                          const SurfaceOptions& options) const;

  ScanPoints points_;
};

}  // namespace adit
