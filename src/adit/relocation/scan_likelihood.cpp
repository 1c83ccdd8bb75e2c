#include "adit/relocation/scan_likelihood.hpp"

#include <algorithm>
#include <cmath>

namespace adit {
namespace {

// Flatter than this rock often returns nothing.
constexpr double kFlatCosine = 0.2;

// An unevenly spaced scan takes its ranges from so many even rays.
constexpr std::size_t kEvenRays = 720;

}  // namespace

void ScanLikelihood::set_scan(const LaserScan& scan, const ScannerModel& scanner,
                              const MapError& error, const LikelihoodOptions& options) {
  options_ = options;
  reach_ = scanner.no_return_from(scan.max_range);
  noise_ = std::max(1e-6, scanner.beam_sigma_m() * scanner.beam_sigma_m());
  const std::size_t count = scan.beams_of_one_turn();
  const std::size_t stride =
      std::max<std::size_t>(1, count / static_cast<std::size_t>(std::max(1, options.beams)));
  evenly_spaced_ = scan.bearings.empty();
  first_bearing_ = scan.first_bearing;
  bearing_step_ = scan.bearing_step * static_cast<double>(stride);
  beams_.clear();
  for (std::size_t i = 0; i < count; i += stride) {
    const double range = scan.ranges[i];
    const bool has_return = range > 0.0 && range >= scanner.min_range_m && range < reach_;
    beams_.push_back({scan.bearing(i), has_return ? range : reach_, has_return});
  }
  set_map_error(error);
  const double away = options.leave_ratio;
  const double back = options.back_ratio;
  const double mixed = 1.0 - std::pow(1.0 - away - back, static_cast<double>(stride));
  leave_ = away / (away + back) * mixed;
  back_ = back / (away + back) * mixed;
}

void ScanLikelihood::set_map_error(const MapError& error) {
  map_noise_ = error.sigma_m() * error.sigma_m();
  double news = 0.0;
  double returns = 0.0;
  for (const Beam& beam : beams_) {
    if (!beam.has_return) continue;
    const double spacing = beam.range * std::abs(bearing_step_);
    const double alike = std::max(1.0, options_.piece_m / std::max(spacing, 1e-3));  // beams
    returns += 1.0;
    news += (map_noise_ + noise_) / (alike * map_noise_ + noise_);
  }
  share_of_news_ = returns > 0.0 ? news / returns : 1.0;
}

void ScanLikelihood::look_around(const LineMap& map, const Pose2& map_from_laser) {
  visibility_.sweep(map, map_from_laser.translation(), reach_);
  const std::size_t rays = evenly_spaced_ ? beams_.size() : kEvenRays;
  ranges_.resize(rays);
  walls_.resize(rays);
  if (evenly_spaced_) {
    visibility_.ranges(map_from_laser.theta + first_bearing_, bearing_step_, ranges_, walls_);
  } else {
    visibility_.ranges(-kPi, kTwoPi / static_cast<double>(rays), ranges_, walls_);
  }
}

ScanLikelihood::Densities ScanLikelihood::densities(const LineMap& map, const Beam& beam,
                                                    double heading, double range, int wall,
                                                    double doubt_m) const {
  if (wall < 0) {
    // The map has nothing in reach.
    if (!beam.has_return) return {1.0, options_.dropout_ratio};
    return {0.0, 1.0 / reach_};
  }
  const Segment& segment = map.walls()[static_cast<std::size_t>(wall)].segment;
  const Vector2d along = (segment.b - segment.a).normalized();
  const double cosine = std::max(0.02, std::abs(cross(along, unit_vector(heading))));
  if (!beam.has_return) {
    const double missed = cosine < kFlatCosine ? 0.3 : options_.dropout_ratio;
    const double close = std::min(1.0, (reach_ - range) / (3.0 * (doubt_m + 1.0)));
    return {1.0 + (missed - 1.0) * std::max(0.0, close), options_.dropout_ratio};
  }
  const double off = beam.range - range;
  const double variance = noise_ + (map_noise_ + doubt_m * doubt_m) / (cosine * cosine);
  const double wall_density =
      std::exp(std::max(-200.0, -0.5 * off * off / variance)) / std::sqrt(kTwoPi * variance);
  const double other =
      off < 0.0 ? (1.0 - options_.long_ratio) / range : options_.long_ratio / std::max(1.0, reach_);
  return {wall_density, other};
}

double ScanLikelihood::at(const LineMap& map, const Pose2& map_from_laser, double doubt_m) {
  look_around(map, map_from_laser);
  double wall = back_ / (leave_ + back_);
  double other = 1.0 - wall;
  double sum = 0.0;
  for (std::size_t k = 0; k < beams_.size(); ++k) {
    const Beam& beam = beams_[k];
    const double heading = map_from_laser.theta + beam.bearing;
    std::size_t ray = k;
    if (!evenly_spaced_) {
      const double turns = (heading + kPi) / kTwoPi;
      ray = static_cast<std::size_t>(
                std::lround((turns - std::floor(turns)) * static_cast<double>(kEvenRays))) %
            kEvenRays;
    }
    const Densities density = densities(map, beam, heading, ranges_[ray], walls_[ray], doubt_m);
    wall *= density.wall;
    other *= density.other;
    const double scale = std::max(wall + other, 1e-200);
    sum += std::log(scale);
    const double stays = (wall * (1.0 - leave_) + other * back_) / scale;
    other = (wall * leave_ + other * (1.0 - back_)) / scale;
    wall = stays;
  }
  return sum;
}

}  // namespace adit
