#include "adit/simulation/vehicle.hpp"

#include <algorithm>
#include <cmath>

#include "adit/simulation/dead_reckoning.hpp"

namespace adit {
namespace {

// Streams of the seed.
constexpr std::uint64_t kScans = 11;
constexpr std::uint64_t kWheels = 12;
constexpr std::uint64_t kHops = 13;
constexpr std::uint64_t kGyro = 14;
constexpr std::uint64_t kGuess = 15;

constexpr double kHopRecovery = 4.0;  // s

PoseWithCovariance draw_first_guess(const Pose2& truth, const DriveOptions& options,
                                    std::uint64_t seed) {
  Random random(seed, kGuess);
  const Vector3d sigma(options.first_guess_sigma_m, options.first_guess_sigma_m,
                       options.first_guess_sigma_rad);
  Vector3d error;
  for (double& value : error) value = random.normal();
  PoseWithCovariance guess;
  guess.pose = Pose2::from_vector(truth.vector() + error.cwiseProduct(sigma));
  guess.covariance = sigma.cwiseAbs2().asDiagonal();
  return guess;
}

Pose2 draw_hop(const DriveOptions& options, Random& random) {
  // Within two sigma: a hop beyond that would put the machine into the wall.
  const auto draw = [&](double sigma) { return sigma * std::clamp(random.normal(), -2.0, 2.0); };
  Pose2 hop;
  hop.x = draw(options.hop_m);
  hop.y = draw(options.hop_m);
  hop.theta = draw(options.hop_rad);
  return hop;
}

double gyro_heading(const StampedPose& truth, const DriveOptions& options, Random& random) {
  const double heading = truth.pose.theta + options.gyro_drift_rad_per_s * truth.stamp +
                         options.gyro_sigma_rad * random.normal();
  if (options.gyro_step_rad <= 0.0) return wrap_angle(heading);
  return wrap_angle(options.gyro_step_rad * std::round(heading / options.gyro_step_rad));
}

void add_gyro(Recording& recording, const DriveOptions& options, std::uint64_t seed) {
  Random random(seed, kGyro);
  for (const StampedPose& truth : recording.truth) {
    recording.gyro.push_back(gyro_heading(truth, options, random));
  }
}

TimedPath add_hops(TimedPath path, const DriveOptions& options, std::uint64_t seed) {
  Random random(seed, kHops);
  std::vector<double> stamps(static_cast<std::size_t>(std::max(0, options.hops)));
  for (double& stamp : stamps) stamp = random.uniform(path.begin(), path.end());
  std::sort(stamps.begin(), stamps.end());
  for (const double stamp : stamps) {
    path = with_hop(path, stamp, draw_hop(options, random), kHopRecovery);
  }
  return path;
}

/// The stops' displacements: none but at the stops that a hop befalls.
std::vector<Pose2> hops_at_stops(std::size_t stops, const DriveOptions& options,
                                 std::uint64_t seed) {
  std::vector<Pose2> hops(stops);
  Random random(seed, kHops);
  for (int i = 0; i < options.hops && stops > 1; ++i) {
    const int stop = 1 + random.below(static_cast<int>(stops) - 1);
    hops[static_cast<std::size_t>(stop)] = draw_hop(options, random);
  }
  return hops;
}

/// Stamps of all sweeps that begin and end within the drive.
std::vector<double> scan_stamps(const TimedPath& path, const ScannerSpec& spec, double rate_hz) {
  std::vector<double> stamps;
  const double lead = first_beam_lead(spec);
  const double tail = spec.model.sweep_s - lead;
  for (int i = 0;; ++i) {
    const double stamp = path.begin() + lead + i / rate_hz;
    if (stamp + tail > path.end() && i > 0) return stamps;
    stamps.push_back(stamp);
  }
}

/// Dead reckoning along a path, from its first knot. The error of a move from knot to knot is drawn
/// once and spread over it, so that the declared noise, which is linear in the move, holds however
/// often the wheels are read.
class Wheels {
 public:
  Wheels(const TimedPath& felt, std::span<const double> knots, const DriveOptions& options,
         std::uint64_t seed)
      : felt_(felt), slip_ratio_(options.slip_ratio) {
    Random random(seed, kWheels);
    moves_.push_back({knots.front(), knots.front(), Pose2{}, Vector3d::Zero()});
    for (std::size_t i = 1; i < knots.size(); ++i) {
      const Pose2 move = inverse(felt.at(knots[i - 1])) * felt.at(knots[i]);
      const Vector3d error = draw_move_error(move, options.odometry, random);
      moves_.back() = {knots[i - 1], knots[i], moves_.back().start, error};
      moves_.push_back({knots[i], knots[i], read(knots[i], moves_.back()), Vector3d::Zero()});
    }
  }

  Pose2 read(double t) const {
    const auto after = std::upper_bound(moves_.begin(), moves_.end(), t,
                                        [](double time, const Move& m) { return time < m.from; });
    return read(t, after == moves_.begin() ? *after : *(after - 1));
  }

 private:
  struct Move {
    double from, to;
    Pose2 start;
    Vector3d error;
  };

  Pose2 read(double t, const Move& move) const {
    const double length = move.to - move.from;
    const double done = length > 0.0 ? std::clamp((t - move.from) / length, 0.0, 1.0) : 0.0;
    return move.start * reported_move(inverse(felt_.at(move.from)) * felt_.at(t), slip_ratio_,
                                      done * move.error);
  }

  const TimedPath& felt_;
  double slip_ratio_;
  std::vector<Move> moves_;  // the last has no end
};

/// When the odometry's error changes: at the scans, or before each by a part of the time between.
std::vector<double> error_knots(const Recording& recording, const DriveOptions& options) {
  const double lead = options.odometry_error_lead / options.scan_rate_hz;
  std::vector<double> knots;
  for (const StampedPose& truth : recording.truth) knots.push_back(truth.stamp - lead);
  if (lead > 0.0) knots.push_back(knots.back() + 1.0 / options.scan_rate_hz);
  return knots;
}

/// Dead reckoning at the scans, and between them at the odometry's own rate.
void add_odometry(const TimedPath& felt, const DriveOptions& options, std::uint64_t seed,
                  Recording& recording) {
  const Wheels wheels(felt, error_knots(recording, options), options, seed);
  // Dead reckoning begins at the first guess.
  const Pose2 onto_guess =
      recording.first_guess.pose * inverse(wheels.read(recording.truth.front().stamp));
  for (const StampedPose& truth : recording.truth) {
    recording.odometry.push_back(onto_guess * wheels.read(truth.stamp));
  }
  if (options.odometry_rate_hz <= 0.0) return;
  for (int i = 0; felt.begin() + i / options.odometry_rate_hz < felt.end(); ++i) {
    const double t = felt.begin() + i / options.odometry_rate_hz;
    recording.wheels.push_back({t, onto_guess * wheels.read(t)});
  }
}

}  // namespace

OdometryNoise mockup_odometry() {
  return {.translation_sigma_ratio = 0.05,
          .rotation_sigma_rad_per_m = radians(2.0) / 1.6,
          .rotation_sigma_ratio = 0.0,
          .translation_floor_m = 0.0,
          .rotation_floor_rad = 0.0};
}

Recording record_stops(const World& world, std::span<const Pose2> stops, const ScannerSpec& spec,
                       const DriveOptions& options, std::uint64_t seed) {
  Recording recording;
  if (stops.empty()) return recording;
  const RayCaster fixed(fixed_segments(world));
  const std::vector<Pose2> hops = hops_at_stops(stops.size(), options, seed);
  Random scans(seed, kScans);
  Random wheels(seed, kWheels);
  recording.first_guess = draw_first_guess(stops.front(), options, seed);
  for (std::size_t i = 0; i < stops.size(); ++i) {
    if (i == 0) {
      recording.odometry.push_back(recording.first_guess.pose);
    } else {
      const Pose2 move = inverse(recording.truth.back().pose) * stops[i];
      const Vector3d error = draw_move_error(move, options.odometry, wheels);
      recording.odometry.push_back(recording.odometry.back() *
                                   reported_move(move, options.slip_ratio, error));
    }
    const double stamp = options.stop_interval_s * static_cast<double>(i);
    recording.truth.push_back({stamp, stops[i] * hops[i]});
    const StampedPose& truth = recording.truth.back();
    LaserScan scan = simulate_scan(fixed, truth.pose, spec, scans, passing_segments(world, truth));
    scan.stamp = stamp;
    recording.scans.push_back(std::move(scan));
  }
  add_gyro(recording, options, seed);
  return recording;
}

Recording record_drive(const World& world, std::span<const Pose2> path, const ScannerSpec& spec,
                       const DriveOptions& options, std::uint64_t seed) {
  Recording recording;
  if (path.empty()) return recording;
  const RayCaster fixed(fixed_segments(world));
  const TimedPath truth = add_hops(
      drive_along(path, options.speed_m_per_s, options.turn_rate_rad_per_s), options, seed);
  Random scans(seed, kScans);
  for (const double stamp : scan_stamps(truth, spec, options.scan_rate_hz)) {
    recording.truth.push_back({stamp, truth.at(stamp)});
    recording.scans.push_back(simulate_sweep(fixed, truth, stamp, spec, scans,
                                             passing_segments(world, recording.truth.back())));
  }
  recording.first_guess = draw_first_guess(recording.truth.front().pose, options, seed);
  add_odometry(without_jumps(truth), options, seed, recording);
  add_gyro(recording, options, seed);
  return recording;
}

}  // namespace adit
