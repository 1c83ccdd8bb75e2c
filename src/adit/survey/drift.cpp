#include "adit/survey/drift.hpp"

#include <Eigen/LU>
#include <cmath>
#include <functional>

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
    : begins_(nodes + 1, 0), edges_(2 * constraints.size()) {
  for (const PoseConstraint& c : constraints) {
    ++begins_[c.from + 1];
    ++begins_[c.to + 1];
  }
  for (std::size_t i = 0; i < nodes; ++i) begins_[i + 1] += begins_[i];
  std::vector<std::size_t> next(begins_.begin(), begins_.end() - 1);
  const double open = 1.0 / (open_m * open_m);
  for (const PoseConstraint& c : constraints) {
    const Matrix3d covariance =
        (c.information + Vector3d(open, open, 1.0).asDiagonal().toDenseMatrix()).inverse();
    edges_[next[c.from]++] = {c.to, true, covariance};
    edges_[next[c.to]++] = {c.from, false, covariance};
  }
}

DriftSearch::DriftSearch(const DriftBound& bound, std::span<const Pose2> poses)
    : bound_(bound), poses_(poses), labels_(bound.begins_.size() - 1) {}

void DriftSearch::begin(std::size_t source) {
  ++search_;
  queue_ = {};
  labels_[source] = {search_, false, 0.0, Matrix3d::Zero()};
  queue_.emplace(0.0, source);
}

void DriftSearch::expand(std::size_t node) {
  const Matrix3d& here = labels_[node].covariance;
  for (const DriftBound::Edge& edge : bound_.edges_of(node)) {
    Label& there = labels_[edge.to];
    const bool is_new = there.search != search_;
    if (!is_new && there.done) continue;
    const Vector2d arm = poses_[edge.to].translation() - poses_[node].translation();
    Matrix3d carry_by = Matrix3d::Identity();
    carry_by(0, 2) = -arm.y();
    carry_by(1, 2) = arm.x();
    const Matrix3d rotation = rotation_of(poses_[edge.forward ? node : edge.to].theta);
    const Matrix3d next =
        carry_by * here * carry_by.transpose() + rotation * edge.covariance * rotation.transpose();
    const double size = size_of(next);
    if (!is_new && size >= there.size) continue;
    there = {search_, false, size, next};
    queue_.emplace(size, edge.to);
  }
}

std::optional<DriftSearch::Reached> DriftSearch::next(double limit_m) {
  while (!queue_.empty()) {
    const std::size_t node = queue_.top().second;
    queue_.pop();
    Label& label = labels_[node];
    if (label.done) continue;
    label.done = true;
    const double metres = std::sqrt(label.covariance(0, 0) + label.covariance(1, 1));
    if (metres > limit_m) continue;
    const RelativeSigma sigma{true, metres, std::sqrt(label.covariance(2, 2))};
    expand(node);
    return Reached{node, sigma};
  }
  return std::nullopt;
}

}  // namespace adit
