#include "adit/relocation/scan_likelihood.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "adit/scan/returns.hpp"

namespace adit {
namespace {

// Flatter than this rock often returns nothing.
constexpr double kFlatCosine = 0.2;

// An unevenly spaced scan takes its ranges from so many even rays.
constexpr std::size_t kEvenRays = 720;

/// Of a range that is off by so much, on a wall whose place across it has such a variance.
double normal_density(double off, double wall_variance, double cosine, double noise) {
  const double variance = noise + wall_variance / (cosine * cosine);
  return std::exp(std::max(-200.0, -0.5 * off * off / variance)) / std::sqrt(kTwoPi * variance);
}

}  // namespace

void ScanLikelihood::set_scan(const LaserScan& scan, const ScannerModel& scanner,
                              const MapError& error, const LikelihoodOptions& options,
                              const BeamPriors& priors) {
  options_ = options;
  priors_ = priors;
  const ReturnLimits limits = return_limits(scan, scanner);
  reach_ = limits.none_from_m;
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
    const bool has_return = limits.is_return(range);
    beams_.push_back({scan.bearing(i), has_return ? range : reach_, has_return});
  }
  stated_noise_ = error.sigma_m() * error.sigma_m();
  set_map_error(error);
  next_ = transition(priors, stride).transpose();
}

void ScanLikelihood::set_map_error(const MapError& error) {
  map_noise_ = error.sigma_m() * error.sigma_m();
  process_ = offset_process(error);
}

double ScanLikelihood::share_of_news() const {
  const double trusted = options_.trusted_error_ratio * options_.trusted_error_ratio;
  const double more = std::sqrt(trusted * stated_noise_ / std::max(1e-12, map_noise_));
  return std::clamp(options_.trust * more, options_.trust,
                    std::max(options_.trust, options_.trust_most));
}

/// The ray among those of `look_around` that a beam follows.
std::size_t ScanLikelihood::ray_of(std::size_t beam, double heading) const {
  if (evenly_spaced_) return beam;
  const double turns = (heading + kPi) / kTwoPi;
  const double part = (turns - std::floor(turns)) * static_cast<double>(kEvenRays);
  return static_cast<std::size_t>(std::lround(part)) % kEvenRays;
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
  sights_.resize(beams_.size());
  Vector2d before = Vector2d::Zero();
  Vector2d normal_before = Vector2d::Zero();
  for (std::size_t k = 0; k < beams_.size(); ++k) {
    const double heading = map_from_laser.theta + beams_[k].bearing;
    const std::size_t ray = ray_of(k, heading);
    Sight& sight = sights_[k];
    sight = {ranges_[ray], 1.0, 0.0};
    if (walls_[ray] < 0) {
      sight.range = std::numeric_limits<double>::infinity();
      normal_before.setZero();
      continue;
    }
    const Segment& segment = map.walls()[static_cast<std::size_t>(walls_[ray])].segment;
    const Vector2d direction = unit_vector(heading);
    const Vector2d along = (segment.b - segment.a).normalized();
    const Vector2d point = sight.range * direction;
    sight.cosine = std::max(0.02, std::abs(cross(along, direction)));
    const Vector2d across = perpendicular(along);
    const Vector2d normal = across.dot(direction) > 0.0 ? Vector2d(-across) : across;
    sight.same_off = process_.correlation(before, normal_before, point, normal);
    before = point;
    normal_before = normal;
    look_beyond(beams_[k], map_from_laser.translation(), direction, walls_[ray], sight);
  }
}

void ScanLikelihood::look_beyond(const Beam& beam, const Vector2d& laser, const Vector2d& direction,
                                 int wall, Sight& sight) const {
  if (field_ == nullptr || !beam.has_return || beam.range < sight.range) return;
  const auto met = field_->meet(laser + beam.range * direction);
  if (!met || met->wall == wall) return;
  sight.beyond_cosine = std::max(0.02, std::abs(met->normal.dot(direction)));
  sight.beyond_off = met->off / sight.beyond_cosine;
}

Vector3d ScanLikelihood::densities(const Beam& beam, const Sight& sight, const Offset& offset,
                                   double doubt_m) const {
  if (!std::isfinite(sight.range)) {
    // The map has nothing in reach.
    if (!beam.has_return) return {1.0, priors_.dropout_ratio, 0.0};
    return {0.0, 1.0 / reach_, 0.0};
  }
  if (!beam.has_return) {
    const double missed = sight.cosine < kFlatCosine ? 0.3 : priors_.dropout_ratio;
    const double close = std::min(1.0, (reach_ - sight.range) / (3.0 * (doubt_m + 1.0)));
    return {1.0 + (missed - 1.0) * std::max(0.0, close), priors_.dropout_ratio,
            priors_.dropout_ratio};
  }
  const double off = beam.range - sight.range;
  const double white = map_noise_ - process_.variance + doubt_m * doubt_m;
  Vector3d densities = Vector3d::Zero();
  densities[Met::kWall] = normal_density(off - offset.mean / sight.cosine, offset.variance + white,
                                         sight.cosine, noise_);
  densities[Met::kOther] = off < 0.0 ? (1.0 - priors_.long_ratio) / sight.range
                                     : priors_.long_ratio / std::max(1.0, reach_);
  if (sight.beyond_cosine > 0.0) {
    densities[Met::kBeyond] =
        normal_density(sight.beyond_off, process_.variance + white, sight.beyond_cosine, noise_);
  }
  return densities;
}

double ScanLikelihood::at(const LineMap& map, const Pose2& map_from_laser, double doubt_m) {
  look_around(map, map_from_laser);
  return in_sight(doubt_m);
}

ScanLikelihood::Best ScanLikelihood::best_at(const LineMap& map, const Pose2& map_from_laser,
                                             double doubt_m, std::span<const double> error_ratios) {
  look_around(map, map_from_laser);
  const double stated = map_noise_;
  const double stated_offset = process_.variance;
  Best best{-std::numeric_limits<double>::infinity(), 1.0};
  for (const double ratio : error_ratios) {
    map_noise_ = ratio * ratio * stated;
    process_.variance = ratio * ratio * stated_offset;
    const double likelihood = in_sight(doubt_m);
    if (likelihood > best.log_likelihood) best = {likelihood, ratio};
  }
  map_noise_ = stated;
  process_.variance = stated_offset;
  return best;
}

/// Log of the density of the beams, from where it was looked around last. The wall's offset is
/// tracked from beam to beam by a Kalman filter, in which a beam counts by the probability that it
/// met the wall (Bar-Shalom and Tse, Automatica 11, 1975).
double ScanLikelihood::in_sight(double doubt_m) const {
  Vector3d met = steady_state(priors_);
  double sum = 0.0;
  Offset offset{0.0, process_.variance};
  for (std::size_t k = 0; k < beams_.size(); ++k) {
    const Beam& beam = beams_[k];
    const Sight& sight = sights_[k];
    const double same = sight.same_off;
    offset.mean *= same;
    offset.variance = process_.carried(offset.variance, same);
    met = met.cwiseProduct(densities(beam, sight, offset, doubt_m));
    const double scale = 1e-200 + met.sum();
    sum += std::log(scale);
    met /= scale;
    if (beam.has_return && std::isfinite(sight.range))
      follow(beam, sight, met[Met::kWall], doubt_m, offset);
    met = next_ * met;
  }
  return sum;
}

/// Takes a beam that met the wall with such a probability.
void ScanLikelihood::follow(const Beam& beam, const Sight& sight, double on_wall, double doubt_m,
                            Offset& offset) const {
  const double white =
      map_noise_ - process_.variance + doubt_m * doubt_m + noise_ * sight.cosine * sight.cosine;
  const double gain = offset.variance / (offset.variance + white);
  const double correction = gain * ((beam.range - sight.range) * sight.cosine - offset.mean);
  offset.mean += on_wall * correction;
  offset.variance =
      std::min(process_.variance, offset.variance * (1.0 - on_wall * gain) +
                                      on_wall * (1.0 - on_wall) * correction * correction);
}

/// Where an edge is near the beam, either side of it may be what it met.
BeamShares ScanLikelihood::shares_at(const LineMap& map, const Pose2& map_from_laser,
                                     double doubt_m) {
  constexpr std::size_t kDense = 1440;
  constexpr double kStep = kTwoPi / static_cast<double>(kDense);
  constexpr double kSigmas = 3.0;
  visibility_.sweep(map, map_from_laser.translation(), reach_);
  dense_ranges_.resize(kDense);
  dense_walls_.resize(kDense);
  visibility_.ranges(-kPi, kStep, dense_ranges_, dense_walls_);
  BeamShares out;
  double expected = 0.0;
  for (const Beam& beam : beams_) {
    const double heading = map_from_laser.theta + beam.bearing;
    const auto middle = static_cast<std::size_t>(std::lround((heading + kPi) / kStep) +
                                                 4 * static_cast<long>(kDense));
    // A wall's edge may lie aside by the map's error.
    const double aside = std::sqrt(map_noise_ + doubt_m * doubt_m) / std::max(1.0, beam.range);
    const auto reach = 1 + static_cast<std::size_t>(2.0 * aside / kStep);
    double nearest = reach_;
    double farthest = 0.0;
    for (std::size_t ray = middle - reach; ray <= middle + reach; ++ray) {
      const double range = std::min(reach_, dense_ranges_[ray % kDense]);
      const int wall = dense_walls_[ray % kDense];
      double tolerance = std::sqrt(noise_);
      if (wall >= 0) {
        const Segment& segment = map.walls()[static_cast<std::size_t>(wall)].segment;
        const Vector2d along = (segment.b - segment.a).normalized();
        const double cosine = std::max(0.02, std::abs(cross(along, unit_vector(heading))));
        tolerance = std::sqrt(noise_ + (map_noise_ + doubt_m * doubt_m) / (cosine * cosine));
      }
      nearest = std::min(nearest, range - kSigmas * tolerance);
      farthest = std::max(farthest, range + kSigmas * tolerance);
    }
    if (!beam.has_return) {
      const bool is_due = farthest < 0.8 * reach_;
      expected += is_due;
      out.missing += is_due;
      continue;
    }
    expected += 1.0;
    out.returns += 1.0;
    const bool is_mapped = std::isfinite(dense_ranges_[middle % kDense]) || farthest < reach_;
    if (!is_mapped && beam.range < nearest) {
      out.unmapped += 1.0;
      continue;
    }
    out.before += beam.range < nearest;
    out.through += beam.range > farthest;
  }
  out.missing /= std::max(1.0, expected);
  if (!(out.returns > 0.0)) return out;
  out.before /= out.returns;
  out.through /= out.returns;
  out.unmapped /= out.returns;
  out.on_wall = 1.0 - out.before - out.through - out.unmapped;
  return out;
}

}  // namespace adit
