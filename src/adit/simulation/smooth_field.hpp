#pragma once

#include <array>
#include <vector>

#include "adit/geometry/pose2.hpp"
#include "adit/simulation/random.hpp"

namespace adit {

/// A smooth random vector field over the plane: its two axes are independent, each has the mean 0
/// and the covariance sigma² exp(-|d|² / reach²) between points d apart, the same everywhere.
///
/// The spectral method (Shinozuka 1971; random Fourier features, Rahimi and Recht 2007): on each
/// axis sigma √(2/N) Σ cos(kᵢ·p + φᵢ), with wave vectors kᵢ normal of sigma √2 / reach on each
/// axis, phases φᵢ uniform, and N = 64 waves.
class SmoothField {
 public:
  /// Zero everywhere.
  SmoothField() = default;
  /// `sigma` on each axis, in the field's unit; `reach` (m) above zero.
  SmoothField(double sigma, double reach, Random& random);

  Vector2d at(const Vector2d& point) const;

 private:
  struct Wave {
    Vector2d vector;  // rad/m
    double phase;
  };
  static double sum(const std::vector<Wave>& waves, const Vector2d& point);

  double amplitude_ = 0.0;
  std::array<std::vector<Wave>, 2> waves_;
};

}  // namespace adit
