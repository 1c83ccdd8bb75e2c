#include "adit/refinement/pose_search.hpp"

#include <algorithm>
#include <cmath>

namespace adit {
namespace {

// From so far off a fit finds back by itself, as a rule (m).
constexpr double kBasin = 0.25;

}  // namespace

PoseLattice::PoseLattice(const PoseWithCovariance& around, const SearchOptions& options) {
  const double sigma_m = std::sqrt(around.covariance.topLeftCorner<2, 2>().trace());
  const double sigma_rad = std::sqrt(around.covariance(2, 2));
  const double reach_m = std::max(options.least_reach_m, options.reach_sigmas * sigma_m);
  const int places = reach_m > kBasin ? kPlaces : 1;
  step_m_ = reach_m / places;
  step_rad_ = std::max(options.least_reach_rad, options.reach_sigmas * sigma_rad) / kHeadings;
  for (int i = -places; i <= places; ++i) {
    for (int j = -places; j <= places; ++j) {
      for (int k = -kHeadings; k <= kHeadings; ++k) {
        poses_[count_++] = {around.pose.x + i * step_m_, around.pose.y + j * step_m_,
                            wrap_angle(around.pose.theta + k * step_rad_)};
      }
    }
  }
}

Matrix3d PoseLattice::spread() const {
  const Vector3d half(0.5 * step_m_, 0.5 * step_m_, 0.5 * step_rad_);
  return half.cwiseAbs2().asDiagonal();
}

}  // namespace adit
