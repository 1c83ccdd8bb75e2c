#include "oracle.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace adit {
namespace {

constexpr double kClutter = 0.1;  // prior of a beam that clutter ends
constexpr double kStray = 1e-3;   // and of one that nothing explains
constexpr double kPlaceMetres = 0.5;
constexpr double kPlaceRadians = radians(2.5);

bool is_one_place(const Vector3d& off) {
  return off.head<2>().norm() <= kPlaceMetres && std::abs(off.z()) <= kPlaceRadians;
}

}  // namespace

double ScanOracle::beam(double measured, double expected) const {
  const ScannerModel& model = scanner_.model;
  const double reach = model.max_range_m;
  const double sigma = model.beam_sigma_m();
  const bool has_return = measured > 0.0 && measured < reach;
  const double dust = scanner_.dust_ratio;
  const double wall = std::max(0.0, 1.0 - kClutter - kStray - dust);
  const double returned = 1.0 - scanner_.dropout_ratio;
  if (!has_return) {
    // The wall is out of reach, or so near to the limit that noise decides.
    const double beyond = std::isfinite(expected)
                              ? 0.5 * std::erfc((reach - expected) / (std::sqrt(2.0) * sigma))
                              : 1.0;
    return std::log(scanner_.dropout_ratio + returned * wall * beyond + kStray);
  }
  const double length = std::min(expected, reach);
  double density = kStray / reach;
  if (std::isfinite(expected)) {
    const double off = (measured - expected) / sigma;
    density += wall * std::exp(-0.5 * off * off) / (sigma * std::sqrt(kTwoPi));
  }
  if (measured < length) {
    density += kClutter / length;
    if (dust > 0.0) {
      density += dust * std::exp(-measured / scanner_.dust_range_m) / scanner_.dust_range_m;
    }
  }
  return std::log(returned * density);
}

double ScanOracle::log_likelihood(const LaserScan& scan, const Pose2& map_from_vehicle) const {
  constexpr double kBeyond = 6.0;  // sigmas past its reach a wall is out of it
  const Pose2 laser = map_from_vehicle * scanner_.vehicle_from_laser;
  const ScannerModel& model = scanner_.model;
  const double reach = model.max_range_m + kBeyond * model.beam_sigma_m();
  double sum = 0.0;
  for (std::size_t i = 0; i < scan.ranges.size(); ++i) {
    const Vector2d along = unit_vector(laser.theta + scan.bearing(i));
    sum += beam(scan.ranges[i], mine_.range(laser.translation(), along, reach));
  }
  return sum;
}

/// A search along the axes within the place, with steps that become smaller where none is better:
/// to half a millimetre, for a beam along a wall sees that twelve times as large.
double ScanOracle::best_near(const LaserScan& scan, const Pose2& map_from_vehicle) const {
  constexpr int kHalvings = 9;
  constexpr int kMostSweeps = 8;  // of one step
  double best = log_likelihood(scan, map_from_vehicle);
  Vector3d off = Vector3d::Zero();
  const auto improve = [&](const Vector3d& by) {
    const Vector3d tried = off + by;
    if (!is_one_place(tried)) return false;
    const double value =
        log_likelihood(scan, Pose2::from_vector(map_from_vehicle.vector() + tried));
    if (value <= best) return false;
    best = value;
    off = tried;
    return true;
  };
  Vector3d step(0.5 * kPlaceMetres, 0.5 * kPlaceMetres, 0.5 * kPlaceRadians);
  for (int i = 0; i < kHalvings; ++i, step *= 0.5) {
    bool is_better = true;
    for (int sweep = 0; is_better && sweep < kMostSweeps; ++sweep) {
      is_better = false;
      for (int axis = 0; axis < 3; ++axis) {
        const Vector3d along = step[axis] * Vector3d::Unit(axis);
        is_better = improve(along) || improve(-along) || is_better;
      }
    }
  }
  return best;
}

double ScanOracle::lead_of_truth(const LaserScan& scan, const Pose2& truth,
                                 const Pose2& believed) const {
  if (is_one_place(difference(truth, believed))) return 0.0;
  return best_near(scan, truth) - best_near(scan, believed);
}

}  // namespace adit
