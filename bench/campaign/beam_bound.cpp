#include "beam_bound.hpp"

#include <cmath>

#include "adit/information/beam.hpp"
#include "adit/information/bound.hpp"
#include "adit/simulation/ray_caster.hpp"

namespace adit {

std::optional<double> WallBeamBound::position_variance(const LaserScan& scan, const Pose2& truth,
                                                       const std::vector<Segment>& others) {
  constexpr double kOfWall = 5.0;  // sigmas; the rest was dust or clutter
  const ScannerModel& model = scanner_.model;
  const double flattest = std::cos(BoundOptions{}.max_incidence_rad);
  const Pose2 laser = truth * scanner_.vehicle_from_laser;
  ranges_.resize(scan.ranges.size());
  walls_.resize(scan.ranges.size());
  visibility_.sweep(mine_, laser.translation(), model.max_range_m);
  visibility_.ranges(wrap_angle(laser.theta + scan.first_bearing), scan.bearing_step, ranges_,
                     walls_);
  const Vector2d lever = laser.translation() - truth.translation();
  Matrix3d information = Matrix3d::Zero();
  for (std::size_t i = 0; i < ranges_.size(); ++i) {
    const double off = std::abs(scan.ranges[i] - ranges_[i]);
    if (walls_[i] < 0 || !scan.has_return(i) || off > kOfWall * model.beam_sigma_m()) continue;
    const Vector2d along = unit_vector(laser.theta + scan.bearing(i));
    if (cast_ray(others, laser.translation(), along) < ranges_[i]) continue;
    const Segment& wall = mine_.walls()[static_cast<std::size_t>(walls_[i])].segment;
    const Vector2d normal = perpendicular((wall.b - wall.a).normalized());
    const double cosine = std::abs(normal.dot(along));
    if (cosine < flattest) continue;
    const Vector3d gradient = range_gradient(ranges_[i], along, normal, lever);
    information += gradient * gradient.transpose() / beam_variance(model, ranges_[i], cosine, 0.0);
  }
  std::optional<Matrix3d> covariance;
  if (information_rank(information, &covariance) < 3 || !covariance) return std::nullopt;
  return covariance->topLeftCorner<2, 2>().trace();
}

}  // namespace adit
