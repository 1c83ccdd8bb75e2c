#include "trial_consistency.hpp"

#include <fmt/core.h>

#include <Eigen/LU>
#include <array>
#include <vector>

#include "adit/evaluation/consistency.hpp"

namespace adit {
namespace {

ClaimedError claimed_error(const Answer& a) {
  const Vector3d error(a.pose.x - a.truth.x, a.pose.y - a.truth.y,
                       angle_between(a.truth.theta, a.pose.theta));
  return {error, a.covariance};
}

/// The same with x along the vehicle and y across it.
ClaimedError in_vehicle(const ClaimedError& row, double heading) {
  Matrix3d turn = Matrix3d::Identity();
  turn.topRows<2>().col(0).head<2>() << std::cos(heading), -std::sin(heading);
  turn.topRows<2>().col(1).head<2>() << std::sin(heading), std::cos(heading);
  return {turn * row.error, turn * row.covariance * turn.transpose()};
}

/// Mean of error² over variance on one axis, where the variance is known.
double axis_nees(std::span<const ClaimedError> rows, int axis) {
  double sum = 0.0;
  double count = 0.0;
  for (const ClaimedError& row : rows) {
    const double variance = row.covariance(axis, axis);
    if (!(variance > 0.0) || !std::isfinite(variance)) continue;
    sum += row.error(axis) * row.error(axis) / variance;
    count += 1.0;
  }
  return sum / count;
}

/// Mean log-likelihood of the errors under their own second moment, the best constant covariance.
double oracle_log_likelihood(std::span<const ClaimedError> in_vehicle) {
  Matrix3d moment = Matrix3d::Zero();
  for (const ClaimedError& row : in_vehicle) moment += row.error * row.error.transpose();
  moment /= static_cast<double>(in_vehicle.size());
  return -0.5 * (3.0 + std::log(moment.determinant()) + 3.0 * std::log(kTwoPi));
}

std::string table(const char* name, std::span<const ClaimedError> map,
                  std::span<const ClaimedError> vehicle) {
  if (map.empty()) return fmt::format("covariances, {}: no answers\n", name);
  const ConsistencyFigures in_map = judge_consistency(map);
  const ConsistencyFigures turned = judge_consistency(vehicle);
  return fmt::format(
      "covariances, {} ({}; {} with an unknown axis, {} invalid)\n"
      "                         all     x       y       theta   along   across\n"
      "  NEES per dof           {:<7.3f} {:<7.3f} {:<7.3f} {:<7.3f} {:<7.3f} {:<7.3f}\n"
      "  inside 95 %            {:<7.4f} {:<7.4f} {:<7.4f} {:<7.4f} {:<7.4f} {:<7.4f}\n"
      "  log-likelihood {:.3f}, of the oracle {:.3f}\n",
      name, in_map.count, in_map.partial + in_map.unknown, in_map.invalid, in_map.per_dof,
      axis_nees(map, 0), axis_nees(map, 1), axis_nees(map, 2), axis_nees(vehicle, 0),
      axis_nees(vehicle, 1), in_map.coverage_95, in_map.axis_coverage_95(0),
      in_map.axis_coverage_95(1), in_map.axis_coverage_95(2), turned.axis_coverage_95(0),
      turned.axis_coverage_95(1), in_map.mean_log_likelihood, oracle_log_likelihood(vehicle));
}

}  // namespace

std::string consistency_text(std::span<const Answer> answers) {
  std::string text;
  for (const bool trusted_only : {false, true}) {
    std::vector<ClaimedError> map;
    std::vector<ClaimedError> vehicle;
    for (const Answer& answer : answers) {
      if (trusted_only && !answer.is_trusted()) continue;
      map.push_back(claimed_error(answer));
      vehicle.push_back(in_vehicle(map.back(), answer.truth.theta));
    }
    text += table(trusted_only ? "ok and degraded" : "all answers", map, vehicle);
  }
  return text;
}

}  // namespace adit
