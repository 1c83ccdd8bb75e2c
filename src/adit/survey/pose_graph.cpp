#include "adit/survey/pose_graph.hpp"

#include <ceres/ceres.h>

#include <Eigen/Eigenvalues>
#include <array>

namespace adit {
namespace {

/// A root of the information: root^T root is the information, also of one that leaves directions
/// open.
Matrix3d root_of(const Matrix3d& information) {
  const Eigen::SelfAdjointEigenSolver<Matrix3d> solver(information);
  return solver.eigenvalues().cwiseMax(0.0).cwiseSqrt().asDiagonal() *
         solver.eigenvectors().transpose();
}

/// Where `to` lies against where the constraint has it, in the frame of `from`.
class RelativePoseCost : public ceres::SizedCostFunction<3, 3, 3> {
 public:
  explicit RelativePoseCost(const PoseConstraint& constraint)
      : measured_(constraint.from_to), root_(root_of(constraint.information)) {}

  bool Evaluate(double const* const* poses, double* residuals, double** jacobians) const override {
    const double* from = poses[0];
    const double* to = poses[1];
    const double c = std::cos(from[2]);
    const double s = std::sin(from[2]);
    const double dx = to[0] - from[0];
    const double dy = to[1] - from[1];
    const double x = c * dx + s * dy;
    const double y = -s * dx + c * dy;
    const Vector3d error(x - measured_.x, y - measured_.y,
                         wrap_angle(to[2] - from[2] - measured_.theta));
    Eigen::Map<Vector3d>(residuals, 3) = root_ * error;
    if (jacobians == nullptr) return true;
    using RowMajor = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;
    if (jacobians[0] != nullptr) {
      Matrix3d j;
      j << -c, -s, y, s, -c, -x, 0.0, 0.0, -1.0;
      Eigen::Map<RowMajor>(jacobians[0], 3, 3) = root_ * j;
    }
    if (jacobians[1] != nullptr) {
      Matrix3d j;
      j << c, s, 0.0, -s, c, 0.0, 0.0, 0.0, 1.0;
      Eigen::Map<RowMajor>(jacobians[1], 3, 3) = root_ * j;
    }
    return true;
  }

 private:
  Pose2 measured_;
  Matrix3d root_;
};

}  // namespace

double squared_error(const PoseConstraint& constraint, const Pose2& from, const Pose2& to) {
  const Vector3d error = difference(constraint.from_to, inverse(from) * to);
  return error.dot(constraint.information * error);
}

double robust_share(const PoseConstraint& constraint, const Pose2& from, const Pose2& to) {
  if (constraint.robust_sigmas <= 0.0) return 1.0;
  const double sigmas2 = constraint.robust_sigmas * constraint.robust_sigmas;
  return 1.0 / (1.0 + squared_error(constraint, from, to) / sigmas2);
}

GraphSummary solve_pose_graph(std::vector<Pose2>& poses,
                              std::span<const PoseConstraint> constraints, int max_iterations) {
  if (poses.size() < 2 || constraints.empty()) return {true, true, 0, 0.0};
  std::vector<std::array<double, 3>> values;
  values.reserve(poses.size());
  for (const Pose2& pose : poses) values.push_back({pose.x, pose.y, pose.theta});
  ceres::Problem problem;
  for (const PoseConstraint& c : constraints) {
    if (!c.information.allFinite() || !c.from_to.is_finite()) continue;
    ceres::LossFunction* loss =
        c.robust_sigmas > 0.0 ? new ceres::CauchyLoss(c.robust_sigmas) : nullptr;
    problem.AddResidualBlock(new RelativePoseCost(c), loss, values[c.from].data(),
                             values[c.to].data());
  }
  if (problem.HasParameterBlock(values.front().data())) {
    problem.SetParameterBlockConstant(values.front().data());
  }
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::SPARSE_NORMAL_CHOLESKY;
  options.max_num_iterations = max_iterations;
  options.function_tolerance = 1e-7;
  options.num_threads = 1;
  options.logging_type = ceres::SILENT;
  ceres::Solver::Summary summary;
  ceres::Solve(options, &problem, &summary);
  if (summary.IsSolutionUsable()) {
    for (std::size_t i = 0; i < poses.size(); ++i) {
      poses[i] = Pose2::from_vector({values[i][0], values[i][1], values[i][2]});
    }
  }
  return {summary.IsSolutionUsable(), summary.termination_type == ceres::CONVERGENCE,
          static_cast<int>(summary.iterations.size()), summary.final_cost};
}

}  // namespace adit
