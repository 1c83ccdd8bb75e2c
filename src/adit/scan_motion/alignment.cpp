#include "adit/scan_motion/alignment.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

namespace adit {

Linearization linearize(std::span<const SurfacePoint> source, const SurfaceMap& target,
                        const Pose2& target_from_source, double reach_m, double scale_m) {
  const RigidTransform carry_by(target_from_source);
  Linearization out;
  for (const SurfacePoint& raw : source) {
    if (!raw.has_normal()) continue;
    ++out.tried;
    const Vector2d arm = carry_by.direction(raw.point.cast<double>());
    const Vector2d point = carry_by.origin + arm;
    const Vector2d facing = carry_by.direction(raw.normal.cast<double>());
    const SurfacePoint* wall =
        target.nearest(point.cast<float>(), facing.cast<float>(), static_cast<float>(reach_m));
    if (wall == nullptr) continue;
    ++out.matched;
    // Both normals are estimates of the same wall's.
    const Vector2d normal = (wall->normal.cast<double>() + facing).normalized();
    const double r = normal.dot(point - wall->point.cast<double>());
    const double u = r / scale_m;
    const double near = 1.0 / (1.0 + u * u);  // one less the loss of Geman and McClure
    const double w = near * near;
    out.closeness += near;
    const Vector3d jacobian(normal.x(), normal.y(), cross(arm, normal));
    out.information += w * jacobian * jacobian.transpose();
    out.gradient += w * r * jacobian;
  }
  return out;
}

void drop_weak_direction(Linearization& lin, const AlignmentOptions& options) {
  const Matrix2d across = lin.information.topLeftCorner<2, 2>();
  const Eigen::SelfAdjointEigenSolver<Matrix2d> solver(across);
  const double strong = solver.eigenvalues()(1);
  if (!(strong > 0.0)) return;
  const double ratio = solver.eigenvalues()(0) / strong;
  if (ratio >= options.holds_ratio) return;
  const double kept = std::clamp(
      (ratio - options.slides_ratio) / (options.holds_ratio - options.slides_ratio), 0.0, 1.0);
  const Vector2d weak = solver.eigenvectors().col(0);
  Matrix3d project = Matrix3d::Identity();
  project.topLeftCorner<2, 2>() -= (1.0 - std::sqrt(kept)) * weak * weak.transpose();
  lin.information = project * lin.information * project;
  lin.gradient = project * lin.gradient;
}

Alignment align(std::span<const SurfacePoint> source, const SurfaceMap& target,
                const PosePrior& prior, const Pose2& start, double beam_sigma_m,
                const AlignmentOptions& options) {
  constexpr double kDone = 1e-4;  // m and rad
  const double variance =
      (beam_sigma_m * beam_sigma_m + options.wall_sigma_m * options.wall_sigma_m) *
      options.shared_error_points;
  const double floor = 3.0 * beam_sigma_m;
  Pose2 pose = start;
  Linearization lin;
  double reach = options.first_reach_m;
  const double last_reach = std::max(options.last_reach_m, floor);
  for (int i = 0; i < options.max_iterations; ++i) {
    const double scale = std::max({options.scale_m, beam_sigma_m * 2.0, 0.3 * reach});
    lin = linearize(source, target, pose, reach, scale);
    drop_weak_direction(lin, options);
    const Matrix3d information = lin.information / variance;
    Matrix3d normal = information + prior.information;
    normal.diagonal().array() += 1e-9 + 1e-9 * normal.trace();
    const Vector3d off = difference(prior.pose, pose);
    const Vector3d gradient = lin.gradient / variance + prior.information * off;
    Vector3d step = -normal.ldlt().solve(gradient);
    if (!step.allFinite()) break;
    const double longest = step.head<2>().norm();
    if (longest > 0.3) step *= 0.3 / longest;
    pose = Pose2::from_vector(pose.vector() + step);
    const bool small = step.head<2>().norm() < kDone && std::abs(step.z()) < kDone;
    if (reach <= last_reach && small) break;
    reach = std::max(last_reach, (small ? 0.5 : 0.75) * reach);
  }
  Alignment out;
  out.target_from_source = pose;
  out.information = lin.information / variance;
  out.matched = lin.matched;
  out.matched_share = lin.tried > 0 ? static_cast<double>(lin.matched) / lin.tried : 0.0;
  out.closeness = lin.mean_closeness();
  return out;
}

}  // namespace adit
