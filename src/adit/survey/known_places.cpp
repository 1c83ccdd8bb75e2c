#include "adit/survey/known_places.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace adit {
namespace {

/// Least squares over some of the places (Umeyama 1991, in the plane).
Pose2 fit_motion(std::span<const Pose2> poses, std::span<const KnownPlace> known,
                 std::span<const std::size_t> rows) {
  Vector2d from = Vector2d::Zero();
  Vector2d to = Vector2d::Zero();
  for (const std::size_t i : rows) {
    from += poses[known[i].keyframe].translation();
    to += known[i].map_from_vehicle.translation();
  }
  from /= static_cast<double>(rows.size());
  to /= static_cast<double>(rows.size());
  constexpr double kHeadingArm = 1.0;  // m: one place alone still tells the heading
  double cosine = 0.0;
  double sine = 0.0;
  for (const std::size_t i : rows) {
    const Pose2& pose = poses[known[i].keyframe];
    const Vector2d a = pose.translation() - from;
    const Vector2d b = known[i].map_from_vehicle.translation() - to;
    const double turn = known[i].map_from_vehicle.theta - pose.theta;
    cosine += a.dot(b) + kHeadingArm * std::cos(turn);
    sine += cross(a, b) + kHeadingArm * std::sin(turn);
  }
  const double theta = std::atan2(sine, cosine);
  const Vector2d turned = RigidTransform(Pose2{0.0, 0.0, theta}).direction(from);
  return {to.x() - turned.x(), to.y() - turned.y(), theta};
}

}  // namespace

Pose2 whole_motion(std::span<const Pose2> poses, std::span<const KnownPlace> known) {
  std::vector<std::size_t> rows(known.size());
  for (std::size_t i = 0; i < rows.size(); ++i) rows[i] = i;
  Pose2 motion = fit_motion(poses, known, rows);
  constexpr int kRounds = 10;  // of trimmed least squares
  for (int round = 0; round < kRounds; ++round) {
    std::vector<double> errors(known.size());
    for (std::size_t i = 0; i < known.size(); ++i) {
      const Pose2 moved = motion * poses[known[i].keyframe];
      errors[i] = difference(known[i].map_from_vehicle, moved).norm();
    }
    std::vector<std::size_t> order(known.size());
    for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return errors[a] < errors[b]; });
    order.resize((order.size() + 1) / 2);
    motion = fit_motion(poses, known, order);
  }
  return motion;
}

GraphSummary solve_with_known_places(std::vector<Pose2>& poses,
                                     std::span<const PoseConstraint> constraints,
                                     std::span<const KnownPlace> known,
                                     const KnownPlacesOptions& options, int max_iterations) {
  if (known.empty()) return {true, true, 0, 0.0};
  const Pose2 motion = whole_motion(poses, known);
  // The map itself is the first node, which stays.
  std::vector<Pose2> nodes = {Pose2{}};
  for (const Pose2& pose : poses) nodes.push_back(motion * pose);
  std::vector<PoseConstraint> all;
  all.reserve(constraints.size() + known.size());
  for (PoseConstraint c : constraints) {
    ++c.from;
    ++c.to;
    all.push_back(c);
  }
  double way = 0.0;
  for (std::size_t i = 1; i < known.size(); ++i) {
    way += (poses[known[i].keyframe].translation() - poses[known[i - 1].keyframe].translation())
               .norm();
  }
  const double stretches = std::max(1.0, way / options.apart_m);
  const double alike = std::max(1.0, static_cast<double>(known.size()) / stretches);
  const double plan = options.plan_sigma_m * options.plan_sigma_m;
  for (const KnownPlace& place : known) {
    Matrix3d covariance = place.covariance;
    covariance.topLeftCorner<2, 2>().diagonal().array() += plan;
    covariance.diagonal().array() += 1e-6;
    all.push_back({0, place.keyframe + 1, place.map_from_vehicle, (alike * covariance).inverse(),
                   options.robust_sigmas});
  }
  const GraphSummary solution = solve_pose_graph(nodes, all, max_iterations);
  poses.assign(nodes.begin() + 1, nodes.end());
  return solution;
}

}  // namespace adit
