#pragma once

#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "adit/geometry/result.hpp"
#include "adit/tracking/estimate.hpp"

namespace adit {

/// One row of `estimates.csv`: an `Estimate` that owns nothing but its count of pairs.
struct EstimateRow {
  double stamp = 0.0;
  Pose2 pose;                              ///< map_from_vehicle
  Matrix3d covariance = Matrix3d::Zero();  ///< over (x, y, theta) in the map frame
  Status status = Status::lost;
  double protection_m = std::numeric_limits<double>::infinity();
  double chi_square = 0.0;
  int degrees_of_freedom = 0;
  int pairs = 0;
  bool dead_reckoned = true;
  /// The direction (unit vector, map axes) that the scan does not show; zero where it shows both,
  /// or where it is the heading that is open (status `degraded`).
  Vector2d open_direction = Vector2d::Zero();
};

/// The row that an estimate makes.
EstimateRow to_row(const Estimate& estimate);

/// Writes a row for each estimate under a header. Stamps have six decimals and all else its full
/// digits; a variance or protection level that is unknown (not finite) is `inf`, and a covariance
/// with such a variance 0. Whole or not at all.
Result<void> write_estimates(std::span<const EstimateRow> rows, const std::string& path);

/// The text that `write_estimates` writes.
std::string format_estimates(std::span<const EstimateRow> rows);

/// Reads rows by the names in the header: `t,x,y,theta,cov_xx,cov_xy,cov_xt,cov_yy,cov_yt,cov_tt,
/// status,protection_m` must be there, the rest may. Errors name the line and what was expected.
Result<std::vector<EstimateRow>> read_estimates(const std::string& path);

/// The same from text; `file` is the name in errors.
Result<std::vector<EstimateRow>> parse_estimates(std::string_view text,
                                                 const std::string& file = {});

}  // namespace adit
