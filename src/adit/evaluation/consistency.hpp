#pragma once

#include <cstdint>
#include <limits>
#include <span>

#include "adit/geometry/pose2.hpp"

namespace adit {

/// Estimate minus truth over (x, y, theta) in the map frame (theta the smallest turn), and the
/// covariance that the estimate claimed, where an infinite variance is "unknown".
struct ClaimedError {
  Vector3d error = Vector3d::Zero();
  Matrix3d covariance = Matrix3d::Zero();
};

/// Whether claimed covariances are honest: the normalised squared error e^T P^-1 e (NEES,
/// Bar-Shalom, Li and Kirubarajan 2001, 5.4) is chi-square if they are.
///
/// A row with an unknown variance is judged on its other axes, by the marginal of the covariance
/// over them. A row whose covariance is no covariance (not positive definite, not-a-number) counts
/// in `invalid` and nowhere else. Figures without data are not-a-number.
struct ConsistencyFigures {
  static constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  std::int64_t count = 0;    ///< rows judged
  std::int64_t partial = 0;  ///< of these, with one or two axes unknown
  std::int64_t unknown = 0;  ///< rows that claim nothing
  std::int64_t invalid = 0;
  double per_dof = kNone;      ///< sum of NEES over sum of axes; honest is 1, over-confident above
  double coverage_95 = kNone;  ///< share of rows inside their 95 % region
  Vector3d axis_coverage_95 = Vector3d::Constant(kNone);  ///< x, y, theta within 1.96 sigma
  double mean_log_likelihood = kNone;  ///< of the errors under the claims; rows with all axes
};

/// Judges the rows; errors that are not finite count as infinite.
ConsistencyFigures judge_consistency(std::span<const ClaimedError> rows);

}  // namespace adit
