#include "adit/information/bound.hpp"

#include <Eigen/Eigenvalues>

#include "adit/information/beam.hpp"

namespace adit {
namespace {

bool share_vertex(const Wall& a, const Wall& b) {
  const auto has = [&b](int vertex) {
    return vertex >= 0 && (vertex == b.vertex_a || vertex == b.vertex_b);
  };
  return has(a.vertex_a) || has(a.vertex_b);
}

/// Whether the surface may break between two neighbouring beams.
bool is_edge_between(const LineMap& map, int wall, int neighbour) {
  if (wall == neighbour) return false;
  if (wall < 0 || neighbour < 0) return true;
  return !share_vertex(map.walls()[static_cast<std::size_t>(wall)],
                       map.walls()[static_cast<std::size_t>(neighbour)]);
}

bool is_beside_edge(const LineMap& map, const std::vector<int>& walls, std::size_t beam,
                    bool full_circle) {
  const std::size_t count = walls.size();
  const bool has_previous = beam > 0 || full_circle;
  const bool has_next = beam + 1 < count || full_circle;
  return (has_previous && is_edge_between(map, walls[beam], walls[(beam + count - 1) % count])) ||
         (has_next && is_edge_between(map, walls[beam], walls[(beam + 1) % count]));
}

/// Fills the workspace with the range and the wall of each beam, counter-clockwise (a sum over the
/// beams does not mind their order), and returns the bearing of the first one in the map.
double cast(const LineMap& map, const Pose2& map_from_laser, const ScannerModel& scanner,
            const BeamFan& fan, BoundWorkspace& workspace) {
  const double lowest = fan.bearing_step < 0.0
                            ? fan.first_bearing + (fan.count - 1) * fan.bearing_step
                            : fan.first_bearing;
  const double first = wrap_angle(map_from_laser.theta + lowest);
  workspace.ranges.resize(static_cast<std::size_t>(fan.count));
  workspace.walls.resize(static_cast<std::size_t>(fan.count));
  workspace.visibility.sweep(map, map_from_laser.translation(), scanner.max_range_m);
  workspace.visibility.ranges(first, std::abs(fan.bearing_step), workspace.ranges, workspace.walls);
  return first;
}

}  // namespace

BeamFan beam_fan(const LaserScan& scan) {
  return {scan.first_bearing, scan.bearing_step, static_cast<int>(scan.ranges.size()),
          scan.vehicle_from_laser};
}

int information_rank(const Matrix3d& information, std::optional<Matrix3d>* inverse) {
  // A sum of a thousand rank-one terms carries a relative rounding error of some 1e-13.
  constexpr double kZero = 1e-10;
  if (inverse != nullptr) inverse->reset();
  if (!information.allFinite()) return 0;
  Vector3d scale = Vector3d::Zero();
  for (int axis = 0; axis < 3; ++axis) {
    const double diagonal = information(axis, axis);
    if (diagonal > 0.0) scale(axis) = 1.0 / std::sqrt(diagonal);
  }
  const Matrix3d scaled = scale.asDiagonal() * information * scale.asDiagonal();
  const Eigen::SelfAdjointEigenSolver<Matrix3d> eigen(scaled);
  const int rank = static_cast<int>((eigen.eigenvalues().array() > kZero).count());
  if (rank == 3 && inverse != nullptr) {
    const Matrix3d root = scale.asDiagonal() * eigen.eigenvectors();
    *inverse = root * eigen.eigenvalues().cwiseInverse().asDiagonal() * root.transpose();
  }
  return rank;
}

PoseBound cramer_rao(const LineMap& map, const Pose2& map_from_vehicle, const ScannerModel& scanner,
                     const BeamFan& fan, const BoundOptions& options, BoundWorkspace& workspace) {
  PoseBound bound;
  if (fan.count <= 0 || !map_from_vehicle.is_finite()) return bound;
  const Pose2 map_from_laser = map_from_vehicle * fan.vehicle_from_laser;
  const Vector2d lever_arm = map_from_laser.translation() - map_from_vehicle.translation();
  const double step = std::abs(fan.bearing_step);
  const double first = cast(map, map_from_laser, scanner, fan, workspace);
  const bool full_circle = std::abs(step * fan.count - kTwoPi) < 0.5 * step;
  const double min_cosine = std::cos(options.max_incidence_rad);

  for (std::size_t beam = 0; beam < workspace.ranges.size(); ++beam) {
    const double range = workspace.ranges[beam];
    const int hit = workspace.walls[beam];
    if (hit < 0 || !(range >= scanner.min_range_m && range < scanner.max_range_m)) continue;
    const bool at_edge = is_beside_edge(map, workspace.walls, beam, full_circle);
    if (at_edge) ++bound.edge_beams;
    if (at_edge && !options.use_edge_beams) continue;

    const Segment& wall = map.walls()[static_cast<std::size_t>(hit)].segment;
    const Vector2d normal = perpendicular(wall.b - wall.a).normalized();
    const Vector2d direction = unit_vector(first + static_cast<double>(beam) * step);
    const double cosine = std::abs(normal.dot(direction));
    const double variance = beam_variance(scanner, range, cosine, options.map_sigma_m);
    if (!(cosine > 0.0 && cosine >= min_cosine && variance > 0.0)) continue;
    const Vector3d g = range_gradient(range, direction, normal, lever_arm);
    bound.information += g * g.transpose() / variance;
    ++bound.beams;
  }
  bound.rank = information_rank(bound.information, &bound.covariance);
  return bound;
}

}  // namespace adit
