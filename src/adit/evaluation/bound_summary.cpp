#include "adit/evaluation/bound_summary.hpp"

#include <Eigen/Eigenvalues>
#include <cmath>

namespace adit {

double mean_error_length(const Matrix2d& covariance) {
  const Vector2d variances =
      Eigen::SelfAdjointEigenSolver<Matrix2d>(covariance, Eigen::EigenvaluesOnly).eigenvalues();
  const double large = variances(1);
  if (!(large > 0.0)) return 0.0;
  const double ratio = std::fmin(std::fmax(variances(0) / large, 0.0), 1.0);
  // The average over the angle of the length of the ellipse's half axes: E(k), k² = 1 - ratio.
  return std::sqrt(2.0 * large / kPi) * std::comp_ellint_2(std::sqrt(1.0 - ratio));
}

BoundSummary bound_along(const LineMap& map, std::span<const StampedPose> poses,
                         const ScannerModel& scanner, const BeamFan& fan,
                         const BoundOptions& options) {
  BoundSummary summary;
  BoundWorkspace workspace;
  double position = 0.0;
  double position_squares = 0.0;
  double heading = 0.0;
  double heading_squares = 0.0;
  for (const StampedPose& row : poses) {
    const PoseBound bound = cramer_rao(map, row.pose, scanner, fan, options, workspace);
    if (!bound.covariance) {
      ++summary.unobservable;
      continue;
    }
    const Matrix3d& covariance = *bound.covariance;
    ++summary.count;
    position += mean_error_length(covariance.topLeftCorner<2, 2>());
    position_squares += covariance(0, 0) + covariance(1, 1);
    heading += std::sqrt(2.0 / kPi * covariance(2, 2));
    heading_squares += covariance(2, 2);
  }
  if (summary.count == 0) return summary;
  const auto count = static_cast<double>(summary.count);
  summary.position_mean = position / count;
  summary.position_rms = std::sqrt(position_squares / count);
  summary.heading_mean_deg = degrees(heading / count);
  summary.heading_rms_deg = degrees(std::sqrt(heading_squares / count));
  return summary;
}

}  // namespace adit
