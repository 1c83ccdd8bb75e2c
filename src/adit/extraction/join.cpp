#include "adit/extraction/join.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "adit/extraction/wall_line.hpp"

namespace adit {
namespace {

/// Variance of the line's offset along its normal at the point whose tangential coordinate is t.
double variance_at(const Line& line, double t) {
  return line.covariance(1, 1) - 2.0 * t * line.covariance(0, 1) + t * t * line.covariance(0, 0);
}

}  // namespace

std::optional<Corner> intersect(const Line& before, const Line& after, double min_turn) {
  const double turn = std::abs(angle_between(before.orientation, after.orientation));
  if (turn < min_turn || turn > kPi - 0.05) return std::nullopt;
  const Vector2d n0 = unit_vector(before.orientation);
  const Vector2d n1 = unit_vector(after.orientation);
  Matrix2d normals;
  normals.row(0) = n0;
  normals.row(1) = n1;
  const Matrix2d solve = normals.inverse();

  Corner corner;
  corner.position = solve * Vector2d(before.distance, after.distance);
  const Vector2d offsets(variance_at(before, perpendicular(n0).dot(corner.position)),
                         variance_at(after, perpendicular(n1).dot(corner.position)));
  corner.covariance = solve * offsets.asDiagonal() * solve.transpose();
  const Vector2d arm0 = -perpendicular(n0);  // back along the line before
  const Vector2d arm1 = perpendicular(n1);   // on along the line after
  corner.concave_angle = std::acos(std::clamp(arm0.dot(arm1), -1.0, 1.0));
  const Vector2d middle = arm0 + arm1;
  corner.bisector = std::atan2(middle.y(), middle.x());
  corner.concave_angle_sigma = std::sqrt(before.covariance(0, 0) + after.covariance(0, 0));
  corner.bisector_sigma = 0.5 * corner.concave_angle_sigma;
  corner.points = before.points + after.points;
  return corner;
}

Corner occluding_corner(const Line& line, int arm, const Vector2d& edge, double bearing_sigma) {
  const Vector2d normal = unit_vector(line.orientation);
  const Vector2d tangent = perpendicular(normal);
  const Vector2d end = arm == 0 ? line.end : line.begin;
  Corner corner;
  corner.position = meet(line, edge, end);
  // Never past the last point by more than the gap could hide: grazing beams would run away.
  const double reach = 0.5 * line.length();
  if ((corner.position - end).norm() > reach) corner.position = end;
  const double cosine = std::max(normal.dot(corner.position.normalized()), 0.05);
  const double along = corner.position.norm() / cosine * bearing_sigma;
  corner.covariance = tangent * tangent.transpose() * (along * along) +
                      normal * normal.transpose() * variance_at(line, tangent.dot(end));
  corner.occluding = true;
  corner.points = line.points;
  return corner;
}

}  // namespace adit
