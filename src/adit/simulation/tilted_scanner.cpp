#include "adit/simulation/tilted_scanner.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace adit {

Vector3d tilted_direction(double bearing, const Tilt& tilt) {
  const double x = std::cos(bearing);
  const double y = std::sin(bearing);
  // Ry(pitch) * Rx(roll) of (x, y, 0).
  const double up = y * std::sin(tilt.roll_rad);
  const double left = y * std::cos(tilt.roll_rad);
  const double c = std::cos(tilt.pitch_rad);
  const double s = std::sin(tilt.pitch_rad);
  return {c * x + s * up, left, c * up - s * x};
}

LaserScan simulate_tilted_scan(const RayCaster& fixed, const Pose2& map_from_vehicle,
                               const ScannerSpec& spec, const Tilt& tilt,
                               const RoofAndFloor& heights, Random& random,
                               std::span<const Segment> moving) {
  constexpr double kNever = std::numeric_limits<double>::infinity();
  LaserScan scan;
  scan.first_bearing = spec.first_bearing;
  scan.bearing_step = spec.bearing_step;
  scan.max_range = spec.model.max_range_m;
  scan.vehicle_from_laser = spec.vehicle_from_laser;
  const Pose2 map_from_laser = map_from_vehicle * spec.vehicle_from_laser;
  for (int i = 0; i < spec.beams; ++i) {
    const double jitter =
        spec.model.bearing_sigma_rad > 0.0 ? spec.model.bearing_sigma_rad * random.normal() : 0.0;
    const double bearing = scan.first_bearing + i * scan.bearing_step + jitter;
    const Vector3d beam = tilted_direction(bearing, tilt);
    const double level = beam.head<2>().norm();
    const Vector2d way = unit_vector(map_from_laser.theta + std::atan2(beam.y(), beam.x()));
    const double most = spec.model.max_range_m * level;
    double wall = fixed.range(map_from_laser.translation(), way, most);
    if (!moving.empty()) {
      wall = std::min(wall, cast_ray(moving, map_from_laser.translation(), way, most));
    }
    const double roof = beam.z() > 0.0 ? heights.roof_above_m / beam.z() : kNever;
    const double floor = beam.z() < 0.0 ? heights.floor_below_m / -beam.z() : kNever;
    scan.ranges.push_back(reported_range(std::min({wall / level, roof, floor}), spec, random));
  }
  return scan;
}

}  // namespace adit
