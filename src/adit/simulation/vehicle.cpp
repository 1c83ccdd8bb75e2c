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

/// Dead reckoning at the scans, and between them at the odometry's own rate. The error of a move
/// between two scans is drawn once and spread over it, so that the declared noise, which is linear
/// in the move, holds however often the wheels are read.
void add_odometry(const TimedPath& felt, const DriveOptions& options, std::uint64_t seed,
                  Recording& recording) {
  Random random(seed, kWheels);
  recording.odometry.assign(1, recording.first_guess.pose);
  int reading = 0;
  const auto read_wheels = [&](double until, double from, double to, const Vector3d& error) {
    if (options.odometry_rate_hz <= 0.0) return;
    for (;; ++reading) {
      const double t = felt.begin() + reading / options.odometry_rate_hz;
      if (t >= until) return;
      const Pose2 move = inverse(felt.at(from)) * felt.at(t);
      const double done = to > from ? std::clamp((t - from) / (to - from), 0.0, 1.0) : 0.0;
      recording.wheels.push_back(
          {t, recording.odometry.back() * reported_move(move, options.slip_ratio, done * error)});
    }
  };
  for (std::size_t i = 1; i < recording.truth.size(); ++i) {
    const double from = recording.truth[i - 1].stamp;
    const double to = recording.truth[i].stamp;
    const Pose2 move = inverse(felt.at(from)) * felt.at(to);
    const Vector3d error = draw_move_error(move, options.odometry, random);
    read_wheels(to, from, to, error);
    recording.odometry.push_back(recording.odometry.back() *
                                 reported_move(move, options.slip_ratio, error));
  }
  const double last = recording.truth.back().stamp;
  read_wheels(felt.end(), last, last, Vector3d::Zero());
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
    LaserScan scan =
        simulate_scan(fixed, recording.truth.back().pose, spec, scans, people_at(world, stamp));
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
    recording.scans.push_back(
        simulate_sweep(fixed, truth, stamp, spec, scans, people_at(world, stamp)));
  }
  recording.first_guess = draw_first_guess(recording.truth.front().pose, options, seed);
  add_odometry(without_jumps(truth), options, seed, recording);
  add_gyro(recording, options, seed);
  return recording;
}

}  // namespace adit
