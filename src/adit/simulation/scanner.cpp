#include "adit/simulation/scanner.hpp"

#include <algorithm>
#include <cmath>

namespace adit {
namespace {

ScannerSpec spanning(double degrees_of_view, int beams, const ScannerModel& model) {
  ScannerSpec spec;
  spec.beams = beams;
  spec.bearing_step = radians(degrees_of_view) / (beams - 1);
  spec.first_bearing = -0.5 * radians(degrees_of_view);
  spec.model = model;
  return spec;
}

LaserScan empty_scan(const ScannerSpec& spec, double stamp) {
  LaserScan scan;
  scan.stamp = stamp;
  scan.first_bearing = spec.first_bearing;
  scan.bearing_step = spec.bearing_step;
  scan.max_range = spec.model.max_range_m;
  scan.vehicle_from_laser = spec.vehicle_from_laser;
  scan.ranges.resize(static_cast<std::size_t>(spec.beams));
  return scan;
}

double nearest_surface(const RayCaster& fixed, std::span<const Segment> moving,
                       const Vector2d& origin, const Vector2d& direction, double max_range) {
  const double range = fixed.range(origin, direction, max_range);
  return moving.empty() ? range : std::min(range, cast_ray(moving, origin, direction, max_range));
}

double measure_beam(const RayCaster& fixed, std::span<const Segment> moving,
                    const Pose2& map_from_laser, double bearing, const ScannerSpec& spec,
                    Random& random) {
  const double sigma = spec.model.bearing_sigma_rad;
  const double jitter = sigma > 0.0 ? sigma * random.normal() : 0.0;
  const double range =
      nearest_surface(fixed, moving, map_from_laser.translation(),
                      unit_vector(map_from_laser.theta + bearing + jitter), spec.model.max_range_m);
  return reported_range(range, spec, random);
}

double bearing_of(std::size_t beam, const ScannerSpec& spec) {
  return spec.first_bearing + static_cast<double>(beam) * spec.bearing_step;
}

/// Beams that meet the machine go no farther.
void add_body(const ScannerFaults& faults, LaserScan& scan) {
  if (faults.body_width_rad <= 0.0) return;
  for (std::size_t i = 0; i < scan.ranges.size(); ++i) {
    const double off = std::abs(angle_between(faults.body_bearing_rad, scan.bearing(i)));
    if (off <= 0.5 * faults.body_width_rad) {
      scan.ranges[i] = std::min(scan.ranges[i], faults.body_range_m);
    }
  }
}

}  // namespace

ScannerSpec as_mounted(const ScannerSpec& stated) {
  const ScannerFaults& faults = stated.faults;
  ScannerSpec real = stated;
  if (faults.is_mirrored) {
    real.first_bearing = -stated.first_bearing;
    real.bearing_step = -stated.bearing_step;
  }
  real.vehicle_from_laser.x += faults.mount_x_m;
  real.vehicle_from_laser.y += faults.mount_y_m;
  real.vehicle_from_laser.theta += faults.mount_yaw_rad;
  return real;
}

ScannerSpec cyclone() {
  ScannerSpec spec;
  spec.model = {.range_sigma_m = 0.1,
                .quantisation_m = 0.1,
                .bearing_sigma_rad = 0.0,
                .max_range_m = 50.0,
                .min_range_m = 0.1};
  return spec;
}

ScannerSpec sick() {
  return spanning(270.0, 1081,
                  {.range_sigma_m = 0.015,
                   .quantisation_m = 0.001,
                   .bearing_sigma_rad = 0.0,
                   .max_range_m = 80.0,
                   .min_range_m = 0.05});
}

ScannerSpec sick_lms() {
  return spanning(180.0, 181,
                  {.range_sigma_m = 0.015,
                   .quantisation_m = 0.01,
                   .bearing_sigma_rad = 0.0,
                   .max_range_m = 80.0,
                   .min_range_m = 0.05});
}

ScannerSpec hokuyo() {
  return spanning(727 * 0.33, 728,
                  {.range_sigma_m = 0.03,
                   .quantisation_m = 0.001,
                   .bearing_sigma_rad = 0.0,
                   .max_range_m = 30.0,
                   .min_range_m = 0.06});
}

std::optional<ScannerSpec> scanner_named(std::string_view name) {
  if (name == "cyclone") return cyclone();
  if (name == "sick") return sick();
  if (name == "sick_lms") return sick_lms();
  if (name == "hokuyo") return hokuyo();
  return std::nullopt;
}

double first_beam_lead(const ScannerSpec& spec) {
  switch (spec.model.stamp) {
    case SweepMoment::start:
      return 0.0;
    case SweepMoment::middle:
      return 0.5 * spec.model.sweep_s;
    case SweepMoment::end:
      return spec.model.sweep_s;
  }
  return 0.0;
}

double reported_range(double range, const ScannerSpec& spec, Random& random) {
  const ScannerModel& model = spec.model;
  if (spec.dust_ratio > 0.0 && random.chance(spec.dust_ratio)) {
    range = std::min(range, -spec.dust_range_m * std::log(1.0 - random.uniform()));
  }
  const bool dropped = spec.dropout_ratio > 0.0 && random.chance(spec.dropout_ratio);
  const double noise = model.range_sigma_m * random.normal();
  if (dropped || !(range <= model.max_range_m)) return model.max_range_m;
  double reported = range + noise;
  if (model.quantisation_m > 0.0) {
    reported = model.quantisation_m * std::round(reported / model.quantisation_m);
  }
  return reported < model.min_range_m ? model.max_range_m : std::min(reported, model.max_range_m);
}

LaserScan simulate_scan(const RayCaster& fixed, const Pose2& map_from_vehicle,
                        const ScannerSpec& spec, Random& random, std::span<const Segment> moving) {
  LaserScan scan = empty_scan(spec, 0.0);
  const ScannerSpec real = as_mounted(spec);
  const Pose2 map_from_laser = map_from_vehicle * real.vehicle_from_laser;
  for (std::size_t i = 0; i < scan.ranges.size(); ++i) {
    scan.ranges[i] = measure_beam(fixed, moving, map_from_laser, bearing_of(i, real), spec, random);
  }
  add_body(spec.faults, scan);
  return scan;
}

LaserScan simulate_sweep(const RayCaster& fixed, const TimedPath& map_from_vehicle, double stamp,
                         const ScannerSpec& spec, Random& random, std::span<const Segment> moving) {
  LaserScan scan = empty_scan(spec, stamp);
  const ScannerSpec real = as_mounted(spec);
  const double first = stamp - first_beam_lead(spec);
  for (std::size_t i = 0; i < scan.ranges.size(); ++i) {
    const double fraction = static_cast<double>(i) / static_cast<double>(spec.beams);
    const Pose2 map_from_laser =
        map_from_vehicle.at(first + fraction * spec.model.sweep_s) * real.vehicle_from_laser;
    scan.ranges[i] = measure_beam(fixed, moving, map_from_laser, bearing_of(i, real), spec, random);
  }
  add_body(spec.faults, scan);
  return scan;
}

}  // namespace adit
