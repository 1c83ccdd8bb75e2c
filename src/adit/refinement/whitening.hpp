#pragma once

#include <Eigen/Core>
#include <cmath>

#include "adit/geometry/pose2.hpp"
#include "adit/refinement/map_error.hpp"
#include "adit/refinement/offset_process.hpp"

namespace adit {

/// Normal equations of a least-squares fit over N parameters.
template <int N>
struct NormalEquations {
  using Matrix = Eigen::Matrix<double, N, N>;
  using Vector = Eigen::Matrix<double, N, 1>;
  Matrix information = Matrix::Zero();  ///< lower half while beams are added, then `mirror` it
  Vector score = Vector::Zero();        ///< gradient^T * inverse variance * residual
  double chi_square = 0.0;

  void add(const Vector& gradient, double residual, double weight) {
    for (int i = 0; i < N; ++i) {
      const double weighted = weight * gradient[i];
      for (int j = 0; j <= i; ++j) information(i, j) += weighted * gradient[j];
      score[i] += residual * weighted;
    }
    chi_square += weight * residual * residual;
  }
  void mirror() {
    information.template triangularView<Eigen::StrictlyUpper>() = information.transpose();
  }
  NormalEquations& operator+=(const NormalEquations& other) {
    information += other.information;
    score += other.score;
    chi_square += other.chi_square;
    return *this;
  }
};

/// Makes the residuals of neighbouring beams independent of each other.
///
/// The offset that a wall shares along its length is a Markov process, so one pass of a Kalman
/// filter along the sweep turns residuals and their gradients into innovations: exactly the
/// generalised least squares with the full covariance of all beams, in linear time.
template <int N>
class OffsetWhitener {
 public:
  using Vector = Eigen::Matrix<double, N, 1>;

  explicit OffsetWhitener(const MapError& error) : process_{1.0, error.length_m} {}

  /// The next point that the sweep meets, `normal` towards the scanner.
  void move_to(const Vector2d& hit, const Vector2d& normal) {
    const double correlation = process_.correlation(hit_, normal_, hit, normal);
    hit_ = hit;
    normal_ = normal;
    residual_ *= correlation;
    gradient_ *= correlation;
    state_variance_ = process_.carried(state_variance_, correlation);
  }

  /// What the beam says beyond those before it. `offset`: change of its range per sigma of the
  /// wall's offset (m).
  void add(double residual, const Vector& gradient, double offset, double variance,
           NormalEquations<N>& sum) {
    const double gain = state_variance_ * offset;
    const double residual_innovation = residual - offset * residual_;
    double weight = 1.0 / (gain * offset + variance);
    // A beam that its neighbours gainsay counts less (Huber 1964).
    const double surprise = residual_innovation * residual_innovation * weight;
    if (surprise > kHuber * kHuber) {
      const double inflated = (gain * offset + variance) * std::sqrt(surprise) / kHuber;
      variance = inflated - gain * offset;
      weight = 1.0 / inflated;
    }
    const Vector gradient_innovation = gradient - offset * gradient_;
    sum.add(gradient_innovation, residual_innovation, weight);
    const double kalman = gain * weight;
    residual_ += kalman * residual_innovation;
    gradient_ += kalman * gradient_innovation;
    state_variance_ *= variance * weight;
  }

 private:
  static constexpr double kHuber = 1.8;  // 98 % efficient where all noise is normal

  OffsetProcess process_;             // in sigmas of the offset
  double state_variance_ = 1.0;       // of the offset in its sigmas, after the beams so far
  double residual_ = 0.0;             // the offset as the residuals show it ...
  Vector gradient_ = Vector::Zero();  // ... and what a change of the parameters takes from it
  Vector2d hit_ = Vector2d::Constant(1e9);
  Vector2d normal_ = Vector2d::Zero();
};

}  // namespace adit
