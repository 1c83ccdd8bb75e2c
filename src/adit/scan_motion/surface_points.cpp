#include "adit/scan_motion/surface_points.hpp"

#include <algorithm>
#include <cmath>

namespace adit {
namespace {

/// Distance to the nearer of the two neighbours within the piece.
double spacing_at(const ScanPoints& points, std::size_t i, const ScanPoints::Piece& piece) {
  double spacing = 1e9;
  if (i > piece.begin) spacing = (points.point(i) - points.point(i - 1)).norm();
  if (i + 1 < piece.end) {
    spacing = std::min(spacing, (points.point(i + 1) - points.point(i)).norm());
  }
  return spacing;
}

}  // namespace

SurfacePoint SurfaceMaker::surface_at(std::size_t i, const ScanPoints::Piece& piece, double sigma,
                                      const SurfaceOptions& options) const {
  const Vector2d here = points_.point(i);
  SurfacePoint out{here.cast<float>(), Eigen::Vector2f::Zero()};
  if (piece.end - piece.begin < 3) return out;
  const double reach = std::max({options.least_reach_m, options.reach_sigmas * sigma,
                                 options.reach_spacings * spacing_at(points_, i, piece)});
  const auto is_near = [&](std::size_t j) { return (points_.point(j) - here).norm() <= reach; };
  std::size_t begin = i;
  std::size_t end = i + 1;
  while (begin > piece.begin && is_near(begin - 1)) --begin;
  while (end < piece.end && is_near(end)) ++end;
  if (end - begin < 3) return out;
  const LineFit line = fit_line(points_.moments(begin, end));
  const double n = static_cast<double>(end - begin);
  const double across2 = line.squared_error / (n - 2.0);
  if (across2 > options.flat_sigmas * options.flat_sigmas *
                    (sigma * sigma + options.roughness_m * options.roughness_m)) {
    return out;
  }
  Vector2d normal = perpendicular(line.direction);
  if (normal.dot(here) > 0.0) normal = -normal;  // the laser sits at the origin
  out.normal = normal.cast<float>();
  return out;
}

ScanShape SurfaceMaker::shape(const LaserScan& scan, const ScannerModel& scanner,
                              const SurfaceOptions& options) {
  points_.build(scan, scanner, options.roughness_m, options.grazing_rad);
  const RigidTransform vehicle_from_laser(scan.vehicle_from_laser);
  ScanShape shape;
  shape.eye = vehicle_from_laser.origin.cast<float>();
  const std::size_t most = static_cast<std::size_t>(std::max(1, options.most_points));
  const std::size_t stride = (points_.size() + most - 1) / most;
  const double sigma = scanner.beam_sigma_m();
  shape.points.reserve(std::min(points_.size(), most));
  for (const ScanPoints::Piece& piece : points_.pieces()) {
    std::size_t last = piece.begin;
    for (std::size_t i = piece.begin; i < piece.end; ++i) {
      if (i % stride != 0) continue;
      // What stands close by must not outweigh all the rest.
      const bool too_near = (points_.point(i) - points_.point(last)).norm() < options.spacing_m;
      if (i > piece.begin && too_near) continue;
      last = i;
      shape.points.push_back(carry(vehicle_from_laser, surface_at(i, piece, sigma, options)));
    }
  }
  return shape;
}

}  // namespace adit
