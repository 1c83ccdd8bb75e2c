#include "adit/survey/drift.hpp"

#include <Eigen/LU>
#include <cmath>
#include <functional>
#include <limits>
#include <queue>
#include <utility>

namespace adit {
namespace {

constexpr double kLeverArm = 5.0;  // m; how far from a pose what it sees lies

Matrix3d rotation_of(double theta) {
  Matrix3d rotation = Matrix3d::Identity();
  const Vector2d axis = unit_vector(theta);
  rotation.topLeftCorner<2, 2>() << axis.x(), -axis.y(), axis.y(), axis.x();
  return rotation;
}

double size_of(const Matrix3d& covariance) {
  return covariance(0, 0) + covariance(1, 1) + covariance(2, 2) * kLeverArm * kLeverArm;
}

}  // namespace

DriftBound::DriftBound(std::size_t nodes, std::span<const PoseConstraint> constraints,
                       double open_m)
    : edges_(nodes) {
  const double open = 1.0 / (open_m * open_m);
  for (const PoseConstraint& c : constraints) {
    const Matrix3d covariance =
        (c.information + Vector3d(open, open, 1.0).asDiagonal().toDenseMatrix()).inverse();
    edges_[c.from].push_back({c.to, true, covariance});
    edges_[c.to].push_back({c.from, false, covariance});
  }
}

std::vector<RelativeSigma> DriftBound::from(std::size_t source, std::span<const Pose2> poses,
                                            double limit_m) const {
  // Covariances of positions in the common frame, of headings, and between them.
  std::vector<Matrix3d> covariances(edges_.size(), Matrix3d::Zero());
  std::vector<double> sizes(edges_.size(), std::numeric_limits<double>::infinity());
  std::vector<RelativeSigma> out(edges_.size());
  using Entry = std::pair<double, std::size_t>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
  sizes[source] = 0.0;
  queue.emplace(0.0, source);
  while (!queue.empty()) {
    const auto [size, node] = queue.top();
    queue.pop();
    if (size > sizes[node]) continue;
    const Matrix3d& here = covariances[node];
    const double metres = std::sqrt(here(0, 0) + here(1, 1));
    if (metres > limit_m) continue;
    out[node] = {true, metres, std::sqrt(here(2, 2))};
    for (const Edge& edge : edges_[node]) {
      const Vector2d arm = poses[edge.to].translation() - poses[node].translation();
      Matrix3d carry_by = Matrix3d::Identity();
      carry_by(0, 2) = -arm.y();
      carry_by(1, 2) = arm.x();
      const Matrix3d rotation = rotation_of(poses[edge.forward ? node : edge.to].theta);
      const Matrix3d next = carry_by * here * carry_by.transpose() +
                            rotation * edge.covariance * rotation.transpose();
      const double next_size = size_of(next);
      if (next_size >= sizes[edge.to]) continue;
      sizes[edge.to] = next_size;
      covariances[edge.to] = next;
      queue.emplace(next_size, edge.to);
    }
  }
  return out;
}

}  // namespace adit
