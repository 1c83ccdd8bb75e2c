#include "adit/tracking/pose_tracker.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>

namespace adit {
namespace {

// What a direction that no scan observes is known to: far more than any prior (m, m, rad).
const Vector3d kUnobserved(1e3, 1e3, 10.0);

/// A scan's fix: what it says of the pose, and how its covariance splits.
struct Fix {
  Matrix3d covariance;
  Matrix3d noise;
  Matrix3d bias;
};

Fix fix_of(const PoseObservation& observation) {
  Fix fix;
  fix.covariance = fix_covariance(observation.information);
  fix.noise = fix_covariance(observation.noise_information);
  fix.bias = fix.covariance - fix.noise;
  return fix;
}

/// How much of a fix to take on one axis, if its bias and the prediction's are the same error.
double axis_gain(double noise, double bias, double fix_noise, double fix_bias) {
  const double root = std::sqrt(std::max(0.0, bias));
  const double step = std::sqrt(std::max(0.0, fix_bias)) - root;
  const double denominator = noise + fix_noise + step * step;
  return denominator > 0.0 ? std::clamp((noise - root * step) / denominator, 0.0, 1.0) : 0.0;
}

}  // namespace

Matrix3d fix_covariance(const Matrix3d& information) {
  const Vector3d least = kUnobserved.cwiseAbs2().cwiseInverse();
  return (information + Matrix3d(least.asDiagonal())).inverse();
}

Matrix3d unknown_covariance() {
  return Vector3d::Constant(std::numeric_limits<double>::infinity()).asDiagonal();
}

void PoseTracker::blur(double metres, double radians) {
  const Vector3d variance = Vector3d(metres, metres, radians).cwiseAbs2();
  estimate_.covariance += variance.asDiagonal();
}

void PoseTracker::start(const PoseWithCovariance& map_from_vehicle) {
  // Nobody knows a pose better than this; a covariance without any of it has no inverse.
  constexpr double kLeastVariance = 1e-12;
  estimate_ = map_from_vehicle;
  estimate_.covariance.diagonal().array() += kLeastVariance;
  bias_.setZero();
}

void PoseTracker::predict(const Pose2& move, const OdometryNoise& noise,
                          const TrackingOptions& options) {
  const PoseWithCovariance before = estimate_;
  estimate_ = dead_reckon(before, move, noise);
  const Vector2d way = estimate_.pose.translation() - before.pose.translation();
  Matrix3d carried = Matrix3d::Identity();
  carried.topRightCorner<2, 1>() = perpendicular(way);
  const double metres = way.norm() + options.bias_lever_m * std::abs(move.theta);
  const double kept = std::exp(-2.0 * metres / options.bias_distance_m);
  bias_ = kept * carried * bias_ * carried.transpose();
}

Vector3d PoseTracker::innovation_of(const PoseObservation& observation) const {
  return difference(estimate_.pose, observation.pose) +
         fix_covariance(observation.information) * observation.score;
}

double PoseTracker::chi_square(const PoseObservation& observation) const {
  const Vector3d innovation = innovation_of(observation);
  const Matrix3d spread = estimate_.covariance + fix_covariance(observation.information);
  return innovation.dot(spread.inverse() * innovation);
}

double PoseTracker::update(const PoseObservation& observation, const TrackingOptions& options) {
  const Fix fix = fix_of(observation);
  const Vector3d innovation = innovation_of(observation);
  const double chi_square = this->chi_square(observation);
  if (chi_square > options.gate_chi_square) {
    estimate_.covariance *= chi_square / options.gate_chi_square;
  }
  // In these axes the prediction has unit variance, and the fix no correlations.
  const Eigen::LLT<Matrix3d> root(estimate_.covariance);
  const Matrix3d lower = root.matrixL();
  const Matrix3d from_lower = lower.inverse();
  Eigen::SelfAdjointEigenSolver<Matrix3d> eigen;
  eigen.computeDirect(from_lower * fix.covariance * from_lower.transpose());
  const Matrix3d axes = lower * eigen.eigenvectors();
  const Matrix3d to_axes = eigen.eigenvectors().transpose() * from_lower;
  const auto seen = [&](const Matrix3d& covariance) {
    return Matrix3d(to_axes * covariance * to_axes.transpose());
  };
  const Matrix3d bias = seen(bias_);
  const Matrix3d noise = Matrix3d::Identity() - bias;
  const Matrix3d fix_bias = seen(fix.bias);
  const Matrix3d fix_noise = seen(fix.noise);
  Vector3d gain;
  for (int i = 0; i < 3; ++i) {
    gain[i] = axis_gain(noise(i, i), bias(i, i), fix_noise(i, i), fix_bias(i, i));
  }
  const Vector3d rest = Vector3d::Ones() - gain;
  const auto scaled = [](const Vector3d& by, const Matrix3d& covariance) {
    return Matrix3d(by.asDiagonal() * covariance * by.asDiagonal());
  };
  const Matrix3d noise_left = scaled(rest, noise) + scaled(gain, fix_noise);
  const Matrix3d kept_bias = scaled(rest, bias);
  const Matrix3d new_bias = scaled(gain, fix_bias);
  Matrix3d bias_left = kept_bias + new_bias;
  for (int i = 0; i < 3; ++i) {
    bias_left(i, i) += 2.0 * std::sqrt(std::max(0.0, kept_bias(i, i) * new_bias(i, i)));
  }
  const Vector3d move = axes * gain.cwiseProduct(to_axes * innovation);
  bias_ = axes * bias_left * axes.transpose();
  estimate_.covariance = bias_ + axes * noise_left * axes.transpose();
  estimate_.covariance = 0.5 * (estimate_.covariance + estimate_.covariance.transpose()).eval();
  estimate_.pose = {estimate_.pose.x + move.x(), estimate_.pose.y + move.y(),
                    wrap_angle(estimate_.pose.theta + move.z())};
  return chi_square;
}

}  // namespace adit
