#include "adit/tracking/protection.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace adit {
namespace {

struct Normal2 {
  double major = 0.0;  // standard deviations (m)
  double minor = 0.0;
};

Normal2 position_part(const Matrix3d& covariance) {
  const double middle = 0.5 * (covariance(0, 0) + covariance(1, 1));
  const double half = std::hypot(0.5 * (covariance(0, 0) - covariance(1, 1)), covariance(0, 1));
  return {std::sqrt(middle + half), std::sqrt(std::max(0.0, middle - half))};
}

}  // namespace

double radius_of(const Matrix3d& covariance, double risk) {
  const Normal2 normal = position_part(covariance);
  // Exact for a circle: sqrt(-2 ln risk). For a line the two-sided quantile, by the tail's leading
  // terms; between the two the squares of the ratio interpolate, up to 4 % too wide.
  const double circle = std::sqrt(-2.0 * std::log(risk));
  double line = circle;
  for (int i = 0; i < 4; ++i) {
    line = std::sqrt(std::max(0.0, -2.0 * std::log(risk * line * std::sqrt(0.5 * kPi))));
  }
  const double ratio = normal.major > 0.0 ? normal.minor / normal.major : 0.0;
  return normal.major * (line + (circle - line) * ratio * ratio);
}

double protection_level(const PoseWithCovariance& estimate, const PoseWithCovariance& prediction,
                        const Pose2& fitted_at, std::span<const WallEvidence> walls,
                        const ProtectionOptions& options) {
  double level = radius_of(estimate.covariance, options.risk);
  const Matrix3d prior = prediction.covariance.inverse();
  const Matrix3d loose_prior = prior / options.loose_prior;
  WallEvidence all;
  for (const WallEvidence& wall : walls) {
    all.information += wall.information;
    all.score += wall.score;
  }
  const Vector3d to_prediction = difference(fitted_at, prediction.pose);
  const Vector3d to_estimate = difference(fitted_at, estimate.pose);
  for (const WallEvidence& wall : walls) {
    const Matrix3d information = all.information - wall.information;
    const Vector3d score = all.score - wall.score + loose_prior * to_prediction;
    const Vector3d without = (information + loose_prior).inverse() * score;
    const double apart = (without - to_estimate).head<2>().norm();
    level = std::max(level, apart + radius_of((information + prior).inverse(), options.risk));
  }
  return options.margin * level;
}

}  // namespace adit
