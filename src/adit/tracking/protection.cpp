#include "adit/tracking/protection.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace adit {
namespace {

// A wall that sways the pose by less is not remembered (m), and no more of them than these.
constexpr double kLeastSway = 0.01;
constexpr std::size_t kMostFollowed = 24;

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

Protection::Protection() {
  followed_.reserve(kMostFollowed);
  before_.reserve(kMostFollowed);
}

double Protection::update(const PoseWithCovariance& estimate, const PoseWithCovariance& prediction,
                          const Pose2& fitted_at, std::span<const WallEvidence> walls,
                          const Matrix3d& plan_error, const ProtectionOptions& options) {
  const Matrix3d prior = prediction.covariance.inverse();
  const Matrix3d loose_prior = prior / options.loose_prior;
  WallEvidence all;
  for (const WallEvidence& wall : walls) {
    all.information += wall.information;
    all.score += wall.score;
  }
  const Vector3d to_prediction = difference(fitted_at, prediction.pose);
  const Vector3d to_estimate = difference(fitted_at, estimate.pose);
  const auto radius = [&](const Matrix3d& covariance) {
    return radius_of(options.margin * options.margin * covariance + plan_error, options.risk);
  };
  double level = radius(estimate.covariance);
  const auto leave_out = [&](const WallEvidence& wall, const Vector3d& followed) {
    const Matrix3d information = all.information - wall.information;
    const Vector3d score = all.score - wall.score + loose_prior * (to_prediction + followed);
    const Vector3d separation = (information + loose_prior).inverse() * score - to_estimate;
    level = std::max(level, separation.head<2>().norm() + radius((information + prior).inverse()));
    keep(wall.wall, separation);
  };
  std::swap(followed_, before_);
  followed_.clear();
  for (const WallEvidence& wall : walls) leave_out(wall, take(wall.wall));
  for (const Followed& past : before_) {
    if (!past.in_sight) leave_out({past.wall, Matrix3d::Zero(), Vector3d::Zero()}, past.separation);
  }
  return level;
}

/// What was remembered of a wall that is in sight again.
Vector3d Protection::take(int wall) {
  for (Followed& past : before_) {
    if (past.wall != wall) continue;
    past.in_sight = true;
    return past.separation;
  }
  return Vector3d::Zero();
}

/// Of the walls that sway the pose, those that do most.
void Protection::keep(int wall, const Vector3d& separation) {
  const auto sway = [](const Vector3d& apart) { return apart.head<2>().squaredNorm(); };
  if (sway(separation) < kLeastSway * kLeastSway) return;
  if (followed_.size() < kMostFollowed) {
    followed_.push_back({wall, separation, false});
    return;
  }
  const auto least = std::min_element(followed_.begin(), followed_.end(),
                                      [&](const Followed& a, const Followed& b) {
                                        return sway(a.separation) < sway(b.separation);
                                      });
  if (sway(least->separation) < sway(separation)) *least = {wall, separation, false};
}

}  // namespace adit
