#include "adit/refinement/beam_residuals.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "adit/information/beam.hpp"

namespace adit {
namespace {

// A beam that ends farther than this from the wall in its way met something else, no neighbour (m).
constexpr double kFarOff = 1.5;

// How much farther than the farthest return the map is looked at (m): walls that are gone.
constexpr double kBeyondReturns = 2.0;

// Room for the walls about a beam's end; where more crowd, the buffer grows.
constexpr std::size_t kMostNear = 256;

// A wall and its neighbours.
constexpr std::size_t kMostMet = 17;

/// How far (m) a return lies along its beam beyond a wall, unless the wall is not there.
std::optional<double> miss_along(const WallLine& line, const Vector2d& end,
                                 const Vector2d& direction) {
  constexpr double kLeastCosine = 0.1;    // a flatter beam does not tell which of two walls it met
  constexpr double kEndTolerance = 0.02;  // m; walls that are drawn to meet
  const double off = line.normal.dot(end - line.foot);
  const double cosine = line.normal.dot(direction);
  if (std::abs(cosine) < kLeastCosine) return std::nullopt;
  const double back = off / cosine;
  const double along = line.along.dot(end - back * direction - line.foot);
  const bool within = along > -kEndTolerance && along < line.length + kEndTolerance;
  return within ? std::optional(back) : std::nullopt;
}

/// How far (m) a wall's line is along a beam, and how far it comes nearer there per metre that it
/// comes nearer along its normal.
struct RangeTo {
  double secant = 0.0;
  double range = 0.0;
};

RangeTo range_to(const WallLine& wall, const Vector2d& origin, const Vector2d& direction) {
  const double secant = 1.0 / wall.normal.dot(direction);
  return {secant, wall.normal.dot(wall.foot - origin) * secant};
}

/// The normal that points towards the scanner.
Vector2d facing(const Vector2d& normal, const Vector2d& direction) {
  return normal.dot(direction) < 0.0 ? normal : Vector2d(-normal);
}

/// How far a return may lie beyond the wall that it met for all that is in doubt (m²).
double variance_of_miss(const WallDoubt& doubt, const Vector2d& normal, const Vector2d& direction,
                        double range, const Vector2d& lever) {
  const double bent = doubt.distortion_ratio * range;
  const double cosine = normal.dot(direction);
  const double walls = (doubt.wall_sigma_m * doubt.wall_sigma_m + bent * bent) / (cosine * cosine);
  const Vector3d gradient = range_gradient(range, direction, normal, lever);
  return walls + doubt.noise_m * doubt.noise_m + gradient.dot(doubt.pose_covariance * gradient);
}

}  // namespace

void BeamResiduals::set_scan(const LaserScan& scan, const ScannerModel& scanner, int missing_wall) {
  const std::size_t count = scan.ranges.size();
  scan_ = &scan;
  has_swept_ = false;
  missing_wall_ = missing_wall;
  limits_ = return_limits(scan, scanner);
  reach_ = std::min(limits_.none_from_m, longest_return() + kBeyondReturns);
  noise_reach_ = 2.0 * scanner.beam_sigma_m();
  timing_ = sweep_timing(scanner, count);
  walls_.resize(count);
  if (beams_.size() < count) beams_.resize(count);  // grows only
  near_.reserve(kMostNear);
  met_.reserve(kMostMet);
  const bool even = scan.bearings.empty();
  const bool known = even && evenly_spaced_;
  evenly_spaced_ = even;
  if (known && directions_.size() == count && first_bearing_ == scan.first_bearing &&
      bearing_step_ == scan.bearing_step) {
    return;
  }
  first_bearing_ = scan.first_bearing;
  bearing_step_ = scan.bearing_step;
  directions_.resize(count);
  for (std::size_t i = 0; i < count; ++i) directions_[i] = unit_vector(scan.bearing(i));
}

/// The farthest return (m): beyond it no wall can be told from none.
double BeamResiduals::longest_return() const {
  double longest = 0.0;
  for (std::size_t i = 0; i < scan_->ranges.size(); ++i) {
    if (is_return(i)) longest = std::max(longest, scan_->ranges[i]);
  }
  return longest;
}

Pose2 BeamResiduals::laser_at(const Pose2& map_from_vehicle, const SweepPath& path,
                              const SweepCorrection& correction, double tau) const {
  return map_from_vehicle * correction.at(tau) * path.at(tau) * scan_->vehicle_from_laser;
}

std::size_t BeamResiduals::station_count(const SweepPath& path, double spacing) const {
  constexpr double kMostStations = 64.0;
  if (!(path.span_s > 0.0)) return 1;
  double way = 0.0;
  Pose2 last = path.stamp_from_vehicle.front() * scan_->vehicle_from_laser;
  for (const Pose2& vehicle : path.stamp_from_vehicle) {
    const Pose2 laser = vehicle * scan_->vehicle_from_laser;
    way += (laser.translation() - last.translation()).norm();
    last = laser;
  }
  // A turn bends the beams' spacing: the same number of stations at least as samples that turn.
  const double turn = std::abs(
      angle_between(path.stamp_from_vehicle.front().theta, path.stamp_from_vehicle.back().theta));
  const double count = std::clamp(std::ceil(std::max(way, turn) / spacing), 1.0, kMostStations);
  return std::min(static_cast<std::size_t>(count), std::max<std::size_t>(1, directions_.size()));
}

void BeamResiduals::compute(const LineMap& map, const Pose2& map_from_vehicle,
                            const SweepPath& path, const SweepCorrection& correction,
                            const RefinementOptions& options, std::size_t stride,
                            const WallDoubt& doubt) {
  size_ = 0;
  neighbours_.reset(map, options.neighbour_reach_m);
  unmapped_ = 0;
  log_unmapped_ = 0.0;
  most_secant_ = 1.0 / std::cos(options.max_incidence_rad);
  const std::size_t count = directions_.size();
  const std::size_t stations = station_count(path, options.station_spacing_m);
  for (std::size_t k = 0; k < stations; ++k) {
    Station station;
    station.begin = k * count / stations;
    station.end = (k + 1) * count / stations;
    const double begin = timing_.at(station.begin);
    const double end = timing_.at(station.end);
    station.tau = 0.5 * (begin + end);
    station.laser = laser_at(map_from_vehicle, path, correction, station.tau);
    if (end > begin) {
      // Within a station the way and the turn are linear in time.
      const Pose2 first = laser_at(map_from_vehicle, path, correction, begin);
      const Pose2 last = laser_at(map_from_vehicle, path, correction, end);
      station.velocity = (last.translation() - first.translation()) / (end - begin);
      station.turn_rate = angle_between(first.theta, last.theta) / (end - begin);
    }
    look_from(map, station, map_from_vehicle.translation(), options, stride, doubt);
  }
}

/// The wall that the beam met: the one in its way or a neighbour, the nearer the likelier. The
/// residual is the mean over all of them by how likely they are: as long as the pose is in doubt,
/// the nearest wall would hold it where it is.
BeamResiduals::Meeting BeamResiduals::meet(const WallLine& in_the_way, double measured,
                                           double range, const Beam& beam, const WallDoubt& doubt) {
  const Vector2d& direction = beam.direction;
  const Vector2d end = beam.origin + measured * direction;
  met_.clear();
  met_.push_back({&in_the_way, measured - range, 0.0});
  std::size_t nearest = 0;
  for (const WallLine& other : neighbours_.of(in_the_way.wall)) {
    if (other.wall == missing_wall_) continue;
    const auto miss = miss_along(other, end, direction);
    if (!miss) continue;
    if (std::abs(*miss) < std::abs(met_[nearest].residual)) nearest = met_.size();
    met_.push_back({&other, *miss, 0.0});
  }
  Meeting met = met_[nearest];
  if (met_.size() == 1) return met;
  const Vector2d normal = facing(met.wall->normal, direction);
  const double variance =
      variance_of_miss(doubt, normal, direction, measured - met.residual, beam.lever);
  if (!(variance > 0.0)) return met;
  const double least = met.residual * met.residual;
  double weights = 0.0;
  double sum = 0.0;
  double squares = 0.0;
  for (const Meeting& one : met_) {
    const double square = one.residual * one.residual;
    const double weight = std::exp(-0.5 * (square - least) / variance);
    weights += weight;
    sum += weight * one.residual;
    squares += weight * square;
  }
  met.residual = sum / weights;
  met.variance = std::max(0.0, squares / weights - met.residual * met.residual);
  return met;
}

/// The wall that the beam met when the one in its way is not there: one close to its end.
bool BeamResiduals::find_wall_beyond(const LineMap& map, const Vector2d& end,
                                     const Vector2d& direction, double reach) {
  near_.clear();
  map.near(end, reach, near_);
  double least = reach;
  for (const int wall : near_) {
    const WallLine line = line_of(map, wall);
    const auto miss = miss_along(line, end, direction);
    if (!miss || !(std::abs(*miss) < least)) continue;
    least = std::abs(*miss);
    beyond_ = line;
  }
  return least < reach;
}

/// Of every so many beams of the station, as many as there is room for.
void BeamResiduals::look_up_walls(const Station& station, std::size_t stride,
                                  std::span<int> walls) const {
  const double turn_per_beam = station.turn_rate * timing_.step_s;
  const auto bearing = [&](std::size_t i) {
    return station.laser.theta + scan_->bearing(i) +
           station.turn_rate * (timing_.at(i) - station.tau);
  };
  if (evenly_spaced_) {
    visibility_.walls_along(bearing(station.begin),
                            static_cast<double>(stride) * (bearing_step_ + turn_per_beam), walls);
    return;
  }
  for (std::size_t k = 0; k < walls.size(); ++k) {
    visibility_.walls_along(bearing(station.begin + k * stride), 1.0, walls.subspan(k, 1));
  }
}

void BeamResiduals::sweep_from(const LineMap& map, const Vector2d& centre, double same_place_m) {
  const bool is_same_map = swept_map_ == map.identity();
  if (has_swept_ && is_same_map && (centre - swept_from_).norm() <= same_place_m) return;
  visibility_.sweep(map, centre, reach_);
  if (!is_same_map) swept_map_ = map.identity();
  has_swept_ = true;
  swept_from_ = centre;
}

BeamResiduals::Beam BeamResiduals::beam_of(const Station& station,
                                           const RigidTransform& map_from_laser,
                                           const Vector2d& vehicle, std::size_t index) const {
  Beam beam;
  beam.index = index;
  beam.tau = timing_.at(index);
  beam.origin = station.laser.translation();
  beam.direction = map_from_laser.direction(directions_[index]);
  if (timing_.step_s != 0.0) {
    const double lag = beam.tau - station.tau;
    beam.origin += lag * station.velocity;
    const double turn = station.turn_rate * lag;
    beam.direction =
        (beam.direction + turn * perpendicular(beam.direction)) / std::sqrt(1.0 + turn * turn);
  }
  beam.lever = beam.origin - vehicle;
  return beam;
}

void BeamResiduals::count_unmapped(std::size_t beam) {
  if (!is_return(beam)) return;
  ++unmapped_;
  log_unmapped_ += std::log(scan_->ranges[beam] / reach_);
}

void BeamResiduals::look_from(const LineMap& map, const Station& station, const Vector2d& vehicle,
                              const RefinementOptions& options, std::size_t stride,
                              const WallDoubt& doubt) {
  const std::size_t count = (station.end - station.begin + stride - 1) / stride;
  const RigidTransform map_from_laser(station.laser);
  const std::span<int> walls(walls_.data(), count);
  sweep_from(map, station.laser.translation(), options.same_place_m);
  look_up_walls(station, stride, walls);
  const bool looks_beyond =
      options.looks_beyond && stride == 1;  // the few beams that lead the way do without
  WallLine wall;
  for (std::size_t k = 0; k < count; ++k) {
    const std::size_t i = station.begin + k * stride;
    if (walls[k] < 0) {
      count_unmapped(i);
      continue;
    }
    if (walls[k] != wall.wall) wall = line_of(map, walls[k]);
    add(map, wall, beam_of(station, map_from_laser, vehicle, i), options, looks_beyond, doubt);
  }
}

/// Puts the beam to the others, unless it is too flat to the wall that it met.
void BeamResiduals::add(const LineMap& map, const WallLine& in_the_way, const Beam& beam,
                        const RefinementOptions& options, bool looks_beyond,
                        const WallDoubt& doubt) {
  const bool has_return = is_return(beam.index);
  RangeTo to = range_to(in_the_way, beam.origin, beam.direction);
  const double measured = has_return ? scan_->ranges[beam.index] : to.range;
  const double excess = measured - to.range;
  Meeting met{&in_the_way, excess, 0.0};
  bool is_beyond = false;
  if (std::abs(excess) > noise_reach_) {  // else the scanner's noise explains the range
    if (std::abs(excess) < kFarOff) met = meet(in_the_way, measured, to.range, beam, doubt);
    is_beyond = looks_beyond && met.wall == &in_the_way && excess > options.neighbour_reach_m &&
                find_wall_beyond(map, beam.origin + measured * beam.direction, beam.direction,
                                 options.neighbour_reach_m);
    if (is_beyond) met.wall = &beyond_;
    if (met.wall != &in_the_way) to = range_to(*met.wall, beam.origin, beam.direction);
    if (is_beyond) met = {&beyond_, measured - to.range, 0.0};
  }
  if (!(std::abs(to.secant) < most_secant_)) return;
  BeamResidual& out = beams_[size_++];
  out.normal = facing(met.wall->normal, beam.direction);
  out.stretch = -std::abs(to.secant);
  out.range = to.range;
  out.has_return = has_return && met.wall->wall != missing_wall_;
  out.residual = out.has_return ? met.residual : 0.0;
  out.measured = out.has_return ? measured : to.range;
  out.wall_variance = met.variance;
  out.direction = beam.direction;
  out.hit = beam.origin + to.range * beam.direction;
  out.gradient = range_gradient(to.range, beam.direction, out.normal, beam.lever);
  out.tau = beam.tau;
  out.beam = static_cast<int>(beam.index);
  out.wall = met.wall->wall;
  out.is_beyond = is_beyond;
}

}  // namespace adit
