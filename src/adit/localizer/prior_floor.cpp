#include "adit/localizer/prior_floor.hpp"

#include <Eigen/Eigenvalues>

namespace adit {

Matrix3d floored(const Matrix3d& covariance, const LocalizerOptions& options) {
  // In units of the floors, so that one eigenvalue decomposition serves metres and radians.
  const Vector3d unit(options.prior_floor_m, options.prior_floor_m, options.prior_floor_rad);
  const Vector3d inverse_unit = unit.cwiseInverse();
  const Matrix3d scaled = inverse_unit.asDiagonal() * covariance * inverse_unit.asDiagonal();
  Eigen::SelfAdjointEigenSolver<Matrix3d> eigen;
  eigen.computeDirect(scaled);
  const Vector3d values = eigen.eigenvalues().cwiseMax(1.0);
  const Matrix3d vectors = eigen.eigenvectors();
  return unit.asDiagonal() * (vectors * values.asDiagonal() * vectors.transpose()) *
         unit.asDiagonal();
}

}  // namespace adit
