#include "adit/relocation/fit_quality.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "adit/tracking/pose_tracker.hpp"

namespace adit {

double shared_ratio(const ScanFit& fit) {
  const double noise = fix_covariance(fit.white_information).determinant();
  const double all = fix_covariance(fit.information).determinant();
  return all > 0.0 ? std::clamp(std::pow(std::max(0.0, noise) / all, 1.0 / 6.0), 0.0, 1.0) : 1.0;
}

double plausibility(const ScanFit& fit, const PoseWithCovariance& prediction, double shared) {
  constexpr double kFreedom = 4.0;
  const Vector3d off = difference(prediction.pose, fit.pose);
  const double chi_square = off.dot(prediction.covariance.inverse() * off);
  return shared * fit.log_likelihood - 0.5 * (kFreedom + 3.0) * std::log1p(chi_square / kFreedom);
}

bool elsewhere(const ScanFit& a, const ScanFit& b) {
  constexpr double kApart = 30.0;  // chi-square, far beyond chance
  const Vector3d apart = difference(a.pose, b.pose);
  const Matrix3d spread = fix_covariance(a.information) + fix_covariance(b.information);
  return apart.dot(spread.inverse() * apart) > kApart;
}

FitQuality quality_of(const ScanFit& fit) {
  FitQuality quality;
  quality.converged = fit.converged;
  const double returns = fit.counts.returns();
  quality.returns = returns;
  if (!(returns > 0.0) || !(fit.expected_log_evidence > 0.0)) return quality;
  quality.evidence_ratio = fit.log_evidence / fit.expected_log_evidence;
  quality.wall_ratio = fit.counts.wall / returns;
  quality.behind_ratio = fit.counts.behind / returns;
  return quality;
}

}  // namespace adit
