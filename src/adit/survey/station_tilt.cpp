#include "adit/survey/station_tilt.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace adit {
namespace {

constexpr double kNever = std::numeric_limits<double>::infinity();
constexpr double kStrange = 4.5;         // what a beam that fits nothing costs: three sigma
constexpr double kIndependent = 0.15;    // share of the beams that speak for themselves
constexpr std::size_t kMostBeams = 360;  // of a scan that are looked at
constexpr double kReach = 3.5;           // sigmas of tilt that are searched
constexpr double kCoarse = radians(0.5);
constexpr double kFine = radians(0.1);

Vector3d beam_of(double bearing, const ScanTilt& tilt) {
  const double x = std::cos(bearing);
  const double y = std::sin(bearing);
  const double up = y * std::sin(tilt.roll_rad);
  const double c = std::cos(tilt.pitch_rad);
  const double s = std::sin(tilt.pitch_rad);
  return {c * x + s * up, y * std::cos(tilt.roll_rad), c * up - s * x};
}

double roof_range(double up, const TiltOptions& options) {
  if (up > 0.0 && options.roof_above_m > 0.0) return options.roof_above_m / up;
  if (up < 0.0 && options.floor_below_m > 0.0) return options.floor_below_m / -up;
  return kNever;
}

/// A beam that met something.
struct Beam {
  double cosine = 1.0;  // of its bearing
  double sine = 0.0;
  double range = 0.0;
  double wall = kNever;
};

std::vector<Beam> beams_of(const LaserScan& scan, std::span<const double> walls) {
  std::vector<Beam> beams;
  const std::size_t step = std::max<std::size_t>(1, scan.ranges.size() / kMostBeams);
  for (std::size_t i = 0; i < scan.ranges.size() && i < walls.size(); i += step) {
    if (!scan.has_return(i)) continue;
    const Vector2d way = unit_vector(scan.bearing(i));
    beams.push_back({way.x(), way.y(), scan.ranges[i], walls[i]});
  }
  return beams;
}

double misfit(const std::vector<Beam>& beams, const ScanTilt& tilt, const TiltOptions& options) {
  double sum = 0.0;
  const double roll = std::sin(tilt.roll_rad) * std::cos(tilt.pitch_rad);
  const double pitch = std::sin(tilt.pitch_rad);
  for (const Beam& beam : beams) {
    const double roof = roof_range(beam.sine * roll - beam.cosine * pitch, options);
    const bool wall_first = beam.wall <= roof;
    const double expected = wall_first ? beam.wall : roof;
    if (expected == kNever) {
      sum += 0.5 * kStrange;
      continue;
    }
    const double sigma = wall_first
                             ? options.wall_error_m
                             : std::hypot(options.wall_error_m, options.roof_error_ratio * roof);
    const double d = (beam.range - expected) / sigma;
    sum += std::min(0.5 * d * d, kStrange);
  }
  const double prior = (tilt.pitch_rad * tilt.pitch_rad + tilt.roll_rad * tilt.roll_rad) /
                       (options.tilt_sigma_rad * options.tilt_sigma_rad);
  return kIndependent * sum + 0.5 * prior;
}

ScanTilt best_around(const std::vector<Beam>& beams, const ScanTilt& middle, double reach,
                     double step, const TiltOptions& options) {
  ScanTilt best = middle;
  double least = misfit(beams, middle, options);
  const int steps = static_cast<int>(std::ceil(reach / step));
  for (int p = -steps; p <= steps; ++p) {
    for (int r = -steps; r <= steps; ++r) {
      const ScanTilt tilt{middle.pitch_rad + p * step, middle.roll_rad + r * step};
      const double here = misfit(beams, tilt, options);
      if (here >= least) continue;
      least = here;
      best = tilt;
    }
  }
  return best;
}

}  // namespace

double range_to_roof_or_floor(double bearing, const ScanTilt& tilt, const TiltOptions& options) {
  return roof_range(beam_of(bearing, tilt).z(), options);
}

ScanTilt estimate_tilt(const LaserScan& scan, std::span<const double> walls,
                       const TiltOptions& options) {
  if (options.tilt_sigma_rad <= 0.0) return {};
  const std::vector<Beam> beams = beams_of(scan, walls);
  const ScanTilt coarse = best_around(beams, {}, kReach * options.tilt_sigma_rad, kCoarse, options);
  return best_around(beams, coarse, kCoarse, kFine, options);
}

LaserScan level_scan(const LaserScan& scan, std::span<const double> walls, const ScanTilt& tilt,
                     const TiltOptions& options, const ScannerModel& scanner) {
  const double none_from = scanner.no_return_from(scan.max_range);
  LaserScan level = scan;
  level.bearings.resize(scan.ranges.size());
  for (std::size_t i = 0; i < scan.ranges.size(); ++i) {
    const double bearing = scan.bearing(i);
    const Vector3d beam = beam_of(bearing, tilt);
    level.bearings[i] = bearing + angle_between(bearing, std::atan2(beam.y(), beam.x()));
    const double roof = roof_range(beam.z(), options);
    const double wall = i < walls.size() ? walls[i] : kNever;
    const double slack = 3.0 * std::hypot(options.wall_error_m, options.roof_error_ratio * roof);
    const bool at_wall = std::abs(scan.ranges[i] - wall) <= 2.0 * options.wall_error_m;
    // Foreshortened, the maximum would look like a return a little nearer.
    const bool none = !scan.has_return(i) || scan.ranges[i] >= none_from;
    if (none || (scan.ranges[i] > roof - slack && !at_wall)) {
      level.ranges[i] = std::numeric_limits<double>::quiet_NaN();
    } else {
      level.ranges[i] = scan.ranges[i] * beam.head<2>().norm();
    }
  }
  return level;
}

}  // namespace adit
