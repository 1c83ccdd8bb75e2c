#include "adit/evaluation/consistency.hpp"

#include <Eigen/Cholesky>
#include <array>

#include "adit/evaluation/chi_square.hpp"

namespace adit {
namespace {

/// A row whose unknown axes were replaced by axes without error, of unit variance and independent
/// of the others: they add nothing, so the rest is judged by its marginal covariance.
struct KnownAxes {
  std::array<bool, 3> is_known{};
  int dof = 0;
  Vector3d error = Vector3d::Zero();
  Matrix3d covariance = Matrix3d::Identity();
};

KnownAxes known_axes(const ClaimedError& row) {
  KnownAxes known;
  for (int i = 0; i < 3; ++i) {
    const double variance = row.covariance(i, i);
    if (std::isinf(variance) && variance > 0.0) continue;
    known.is_known[static_cast<std::size_t>(i)] = true;
    ++known.dof;
    known.error(i) = row.error(i);
    known.covariance(i, i) = variance;
    for (int j = 0; j < i; ++j) {
      if (!known.is_known[static_cast<std::size_t>(j)]) continue;
      known.covariance(i, j) = 0.5 * (row.covariance(i, j) + row.covariance(j, i));
      known.covariance(j, i) = known.covariance(i, j);
    }
  }
  return known;
}

struct Judged {
  bool valid = false;
  double nees = 0.0;
  double log_determinant = 0.0;
};

Judged judge(const KnownAxes& known) {
  Judged result;
  const Vector3d variances = known.covariance.diagonal();
  if (!known.covariance.allFinite() || !(variances.minCoeff() > 0.0)) return result;
  // Metres and radians apart by many decades must not decide what is singular.
  const Vector3d sigma = variances.cwiseSqrt();
  const Vector3d per_sigma = sigma.cwiseInverse();
  const Matrix3d correlation = per_sigma.asDiagonal() * known.covariance * per_sigma.asDiagonal();
  const Eigen::LLT<Matrix3d> factor(correlation);
  if (factor.info() != Eigen::Success) return result;
  const Matrix3d lower = factor.matrixL();
  constexpr double kSmallestPivot = 1e-7;  // square root of rounding in a correlation of one
  if (!(lower.diagonal().minCoeff() > kSmallestPivot)) return result;
  result.valid = true;
  result.log_determinant = 2.0 * (lower.diagonal().array() * sigma.array()).log().sum();
  if (!known.error.allFinite()) {
    result.nees = std::numeric_limits<double>::infinity();
    return result;
  }
  const Vector3d scaled = known.error.cwiseProduct(per_sigma);
  const Vector3d white = lower.triangularView<Eigen::Lower>().solve(scaled);
  result.nees = white.squaredNorm();
  return result;
}

double share(std::int64_t part, std::int64_t whole) {
  return whole > 0 ? static_cast<double>(part) / static_cast<double>(whole)
                   : ConsistencyFigures::kNone;
}

/// Sums over the rows from which the figures follow.
struct Sums {
  std::int64_t dof = 0;
  std::int64_t inside = 0;
  std::array<std::int64_t, 3> axis_rows{};
  std::array<std::int64_t, 3> axis_inside{};
  double nees = 0.0;
  double log_likelihood = 0.0;

  void add(const KnownAxes& known, const Judged& judged, double region_95) {
    constexpr double kInside95 = 1.959963984540054;  // sigma, of a normal variable
    nees += judged.nees;
    dof += known.dof;
    if (judged.nees <= region_95) ++inside;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (!known.is_known[axis]) continue;
      const auto i = static_cast<int>(axis);
      ++axis_rows[axis];
      if (std::abs(known.error(i)) <= kInside95 * std::sqrt(known.covariance(i, i))) {
        ++axis_inside[axis];
      }
    }
    if (known.dof == 3) {
      log_likelihood -= 0.5 * (judged.nees + judged.log_determinant + 3.0 * std::log(kTwoPi));
    }
  }
};

}  // namespace

ConsistencyFigures judge_consistency(std::span<const ClaimedError> rows) {
  const std::array<double, 3> region_95 = {
      chi_square_quantile(0.95, 1), chi_square_quantile(0.95, 2), chi_square_quantile(0.95, 3)};
  ConsistencyFigures result;
  Sums sums;
  for (const ClaimedError& row : rows) {
    const KnownAxes known = known_axes(row);
    if (known.dof == 0) {
      ++result.unknown;
      continue;
    }
    const Judged judged = judge(known);
    if (!judged.valid) {
      ++result.invalid;
      continue;
    }
    ++result.count;
    if (known.dof < 3) ++result.partial;
    sums.add(known, judged, region_95[static_cast<std::size_t>(known.dof - 1)]);
  }
  if (sums.dof > 0) result.per_dof = sums.nees / static_cast<double>(sums.dof);
  result.coverage_95 = share(sums.inside, result.count);
  const std::int64_t full = result.count - result.partial;
  if (full > 0) result.mean_log_likelihood = sums.log_likelihood / static_cast<double>(full);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    result.axis_coverage_95(static_cast<int>(axis)) =
        share(sums.axis_inside[axis], sums.axis_rows[axis]);
  }
  return result;
}

}  // namespace adit
