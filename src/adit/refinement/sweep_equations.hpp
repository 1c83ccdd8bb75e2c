#pragma once

#include <Eigen/LU>
#include <array>

#include "adit/refinement/beam_residuals.hpp"
#include "adit/refinement/refinement.hpp"
#include "adit/refinement/whitening.hpp"

namespace adit {

// Less likely than this to have met the wall: the beam is left out.
inline constexpr double kLeastProbability = 0.01;

// Of odometry's errors in the two halves of a sweep. Wheels slip and scales are off for longer than
// a sweep lasts, but not only.
inline constexpr double kHalvesCorrelation = 1.0 / 3.0;

/// The gradient over the pose and, on the move, over the correction of the sweep's motion.
template <int N>
Eigen::Matrix<double, N, 1> parameters_gradient(const BeamResidual& beam, const RigidTransform& map,
                                                const SweepCorrection& correction) {
  if constexpr (N == 3) {
    return beam.gradient;
  } else {
    const Vector2d across = beam.gradient.head<2>();
    const Vector3d in_vehicle(across.dot(map.axis_x), across.dot(map.axis_y), beam.gradient.z());
    const std::array<double, 2> share = correction.shares(beam.tau);
    Eigen::Matrix<double, 9, 1> gradient;
    gradient << beam.gradient, share[0] * in_vehicle, share[1] * in_vehicle;
    return gradient;
  }
}

/// How the first three parameters follow the others where these are free.
inline Eigen::Matrix<double, 3, 6> gain_of(const NormalEquations<9>& all) {
  return all.information.topRightCorner<3, 6>() *
         all.information.bottomRightCorner<6, 6>().inverse();
}

/// A part of the equations on the first three parameters, the others having followed by `gain`.
inline NormalEquations<3> marginal(const NormalEquations<9>& part,
                                   const Eigen::Matrix<double, 3, 6>& gain) {
  const Eigen::Matrix<double, 3, 6> left =
      part.information.topRightCorner<3, 6>() - gain * part.information.bottomRightCorner<6, 6>();
  NormalEquations<3> out;
  out.information = part.information.topLeftCorner<3, 3>() -
                    gain * part.information.bottomLeftCorner<6, 3>() - left * gain.transpose();
  out.score = part.score.head<3>() - gain * part.score.tail<6>();
  out.chi_square = part.chi_square;
  return out;
}

/// Dead reckoning's word on the correction. What is known is the covariance C of the whole sweep's
/// mean motion. Between an error that is steady and a random walk lie halves whose errors are
/// correlated, by r: each then has 2 C / (1 + r), and the two the information
/// [1, -r; -r, 1] / (2 - 2 r) times C's inverse.
inline void add_motion_prior(const SweepPrior& motion, const SweepCorrection& correction,
                             NormalEquations<9>& sum) {
  const Matrix3d own = motion.covariance.inverse() / (2.0 - 2.0 * kHalvesCorrelation);
  const Matrix3d other = -kHalvesCorrelation * own;
  const Vector3d first = correction.halves[0].vector();
  const Vector3d second = correction.halves[1].vector();
  sum.information.block<3, 3>(3, 3) += own;
  sum.information.block<3, 3>(6, 6) += own;
  sum.information.block<3, 3>(3, 6) += other;
  sum.information.block<3, 3>(6, 3) += other;
  sum.score.segment<3>(3) -= own * first + other * second;
  sum.score.segment<3>(6) -= other * first + own * second;
}

}  // namespace adit
