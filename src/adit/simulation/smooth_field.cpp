#include "adit/simulation/smooth_field.hpp"

#include <cmath>

namespace adit {
namespace {

constexpr int kWaves = 64;  // on each axis: the kurtosis is 3 - 1.5 / kWaves

}  // namespace

SmoothField::SmoothField(double sigma, double reach, Random& random)
    : amplitude_(sigma * std::sqrt(2.0 / kWaves)) {
  const double wave_sigma = std::sqrt(2.0) / reach;
  for (std::vector<Wave>& axis : waves_) {
    for (int i = 0; i < kWaves; ++i) {
      const double x = wave_sigma * random.normal();
      const double y = wave_sigma * random.normal();
      axis.push_back({{x, y}, random.uniform(0.0, kTwoPi)});
    }
  }
}

double SmoothField::sum(const std::vector<Wave>& waves, const Vector2d& point) {
  double total = 0.0;
  for (const Wave& wave : waves) total += std::cos(wave.vector.dot(point) + wave.phase);
  return total;
}

Vector2d SmoothField::at(const Vector2d& point) const {
  if (amplitude_ == 0.0) return Vector2d::Zero();
  return {amplitude_ * sum(waves_[0], point), amplitude_ * sum(waves_[1], point)};
}

}  // namespace adit
