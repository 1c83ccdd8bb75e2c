#include "adit/refinement/pose_search.hpp"

#include <algorithm>
#include <cmath>

namespace adit {

PoseLattice::PoseLattice(const PoseWithCovariance& around, const SearchOptions& options) {
  const double sigma_m = std::sqrt(around.covariance.topLeftCorner<2, 2>().trace());
  const double sigma_rad = std::sqrt(around.covariance(2, 2));
  step_m_ = std::max(options.least_reach_m, options.reach_sigmas * sigma_m) / kPlaces;
  step_rad_ = std::max(options.least_reach_rad, options.reach_sigmas * sigma_rad) / kHeadings;
  std::size_t next = 0;
  for (int i = -kPlaces; i <= kPlaces; ++i) {
    for (int j = -kPlaces; j <= kPlaces; ++j) {
      for (int k = -kHeadings; k <= kHeadings; ++k) {
        poses_[next++] = {around.pose.x + i * step_m_, around.pose.y + j * step_m_,
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
