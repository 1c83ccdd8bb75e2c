#include "adit/survey/wall_hits.hpp"

#include <algorithm>
#include <cmath>

#include "adit/scan/returns.hpp"

namespace adit {
namespace {

constexpr double kLeastReach = 0.15;    // m: roughness of a wall is not its direction
constexpr double kReachOfNoise = 4.0;   // sigmas: then a window of 20 beams tells 3 degrees
constexpr double kSlope = 0.15;         // of a wall where noise along it moves a flat hit
constexpr std::size_t kNeighbours = 2;  // beams beside one that a direction needs at least

}  // namespace

double surface_reach(const ScannerModel& scanner) {
  return std::max(kLeastReach, kReachOfNoise * scanner.beam_sigma_m());
}

const std::vector<WallHit>& WallHitFinder::find(const PosedScan& posed) {
  const LaserScan& scan = posed.scan;
  hits_.clear();
  lone_.clear();
  gather_points(scan);
  const Pose2 map_from_laser = posed.map_from_vehicle * scan.vehicle_from_laser;
  std::size_t begin = 0;
  while (begin < points_.size()) {
    std::size_t end = begin + 1;
    while (end < points_.size() && same_surface(end - 1, std::abs(scan.bearing_step))) ++end;
    if (end - begin > kNeighbours) {
      add_run(posed, map_from_laser, begin, end);
    } else {
      add_lone(map_from_laser, begin, end);
    }
    begin = end;
  }
  return hits_;
}

void WallHitFinder::gather_points(const LaserScan& scan) {
  const std::size_t beams = scan.beams_of_one_turn();
  const ReturnLimits limits = return_limits(scan, scanner_);
  points_.resize(beams);
  ranges_.resize(beams);
  for (std::size_t i = 0; i < beams; ++i) {
    const double range = scan.ranges[i];
    const bool met = limits.is_return(range);
    ranges_[i] = met ? range : -1.0;
    points_[i] = met ? Vector2d(range * unit_vector(scan.bearing(i))) : Vector2d(0.0, 0.0);
  }
}

/// Whether a wall no flatter than the steepest incidence can have brought this beam and the next.
bool WallHitFinder::same_surface(std::size_t beam, double step) const {
  const double a = ranges_[beam];
  const double b = ranges_[beam + 1];
  if (a < 0.0 || b < 0.0) return false;
  const double across = std::min(a, b) * step;
  return std::abs(a - b) <=
         across * std::tan(options_.max_incidence_rad) + 4.0 * scanner_.beam_sigma_m();
}

LineFit WallHitFinder::line_around(std::size_t beam, std::size_t begin, std::size_t end,
                                   double reach) {
  std::size_t first = beam;
  std::size_t last = beam;
  const auto near = [&](std::size_t i) {
    return (points_[i] - points_[beam]).squaredNorm() <= reach * reach;
  };
  while (first > begin && (beam - first < 1 || near(first - 1))) --first;
  while (last + 1 < end && (last - beam < 1 || near(last + 1))) ++last;
  while (last - first < kNeighbours) first > begin ? --first : ++last;
  Moments moments;
  for (std::size_t i = first; i <= last; ++i) {
    const Vector2d p = points_[i] - points_[beam];
    moments.add(p.x(), p.y());
  }
  return fit_line(moments);
}

void WallHitFinder::add_run(const PosedScan& posed, const Pose2& map_from_laser, std::size_t begin,
                            std::size_t end) {
  const RigidTransform carry_out(map_from_laser);
  const double reach = surface_reach(scanner_);
  for (std::size_t i = begin; i < end; ++i) {
    const Vector2d direction = line_around(i, begin, end, reach).direction;
    const LoneBeam beam{carry_out.point(points_[i]), ranges_[i]};
    if (const auto hit = hit_along(posed, beam, carry_out.direction(direction))) {
      hits_.push_back(*hit);
    }
  }
}

void WallHitFinder::add_lone(const Pose2& map_from_laser, std::size_t begin, std::size_t end) {
  const RigidTransform carry_out(map_from_laser);
  for (std::size_t i = begin; i < end; ++i) {
    if (ranges_[i] >= 0.0) lone_.push_back({carry_out.point(points_[i]), ranges_[i]});
  }
}

std::optional<WallHit> WallHitFinder::hit_along(const PosedScan& posed, const LoneBeam& beam,
                                                const Vector2d& direction) const {
  const Pose2 map_from_laser = posed.map_from_vehicle * posed.scan.vehicle_from_laser;
  const Vector2d to_laser = (map_from_laser.translation() - beam.point) / beam.range;
  Vector2d normal = perpendicular(direction);
  double cosine = normal.dot(to_laser);
  if (cosine < 0.0) {
    normal = -normal;
    cosine = -cosine;
  }
  if (cosine < std::cos(options_.max_incidence_rad)) return std::nullopt;
  WallHit hit{beam.point, normal, 0.0, 0.0, beam.range};
  const double range_variance = scanner_.beam_sigma_m() * scanner_.beam_sigma_m();
  const double sine_squared = 1.0 - cosine * cosine;
  const double sideways = scanner_.bearing_sigma_rad * beam.range;
  hit.noise_variance = range_variance * (cosine * cosine + kSlope * kSlope * sine_squared) +
                       sideways * sideways * sine_squared;
  const Vector2d lever = hit.point - posed.map_from_vehicle.translation();
  const Vector3d g(hit.normal.x(), hit.normal.y(), cross(lever, hit.normal));
  const double turn = g.z() * options_.pose_sigma_rad;
  hit.pose_variance =
      g.dot(posed.covariance * g) + options_.pose_sigma_m * options_.pose_sigma_m + turn * turn;
  return hit;
}

}  // namespace adit
