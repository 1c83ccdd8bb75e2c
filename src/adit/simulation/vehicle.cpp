#include "adit/simulation/vehicle.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "adit/simulation/dead_reckoning.hpp"
#include "adit/simulation/wheels.hpp"

namespace adit {
namespace {

// Streams of the seed.
constexpr std::uint64_t kScans = 11;
constexpr std::uint64_t kWheels = 12;
constexpr std::uint64_t kHops = 13;
constexpr std::uint64_t kGyro = 14;
constexpr std::uint64_t kGuess = 15;
constexpr std::uint64_t kNextScanner = 100;  // from one scanner's stream to the next's

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
std::vector<double> scan_stamps(const TimedPath& path, const ScannerSpec& spec, double offset,
                                double rate_hz) {
  std::vector<double> stamps;
  const double lead = first_beam_lead(spec);
  const double tail = spec.model.sweep_s - lead;
  for (int i = 0;; ++i) {
    const double stamp = path.begin() + offset + lead + i / rate_hz;
    if (stamp + tail > path.end() && i > 0) return stamps;
    stamps.push_back(stamp);
  }
}

/// When the odometry's error changes: at the first scanner's scans, or before each by a part of the
/// time between.
std::vector<double> error_knots(const Recording& recording, const DriveOptions& options) {
  const double lead = options.odometry_error_lead / options.scan_rate_hz;
  std::vector<double> knots;
  for (const LaserScan& scan : recording.scans) {
    if (scan.scanner == 0) knots.push_back(scan.stamp - lead);
  }
  if (lead > 0.0) knots.push_back(knots.back() + 1.0 / options.scan_rate_hz);
  return knots;
}

void add_scan_odometry(const Pose2& pose, bool is_lost, Recording& recording) {
  const bool keeps_last = is_lost && !recording.odometry.empty();
  recording.odometry.push_back(keeps_last ? recording.odometry.back() : pose);
  recording.is_without_odometry.push_back(is_lost);
}

/// Dead reckoning at the scans, and between them at the odometry's own rate.
void add_odometry(const TimedPath& felt, const DriveOptions& options, std::uint64_t seed,
                  Recording& recording) {
  const Wheels wheels(felt, error_knots(recording, options), options.odometry, options.slip_ratio,
                      options.faults, seed);
  const OdometryArrival arrival(options.faults, felt.begin(), felt.end(), seed);
  // Dead reckoning begins at the first guess.
  const Pose2 onto_guess =
      recording.first_guess.pose * inverse(wheels.read(recording.truth.front().stamp));
  const auto reckoned = [&](double t) { return onto_guess * wheels.read(t); };
  for (const StampedPose& truth : recording.truth) {
    add_scan_odometry(arrival.pose(truth.stamp, reckoned), arrival.is_lost(truth.stamp), recording);
  }
  if (options.odometry_rate_hz <= 0.0) return;
  for (int i = 0; felt.begin() + i / options.odometry_rate_hz < felt.end(); ++i) {
    const double t = felt.begin() + i / options.odometry_rate_hz;
    if (!arrival.is_lost(t)) recording.wheels.push_back({t, arrival.pose(t, reckoned)});
  }
}

/// The same at stops, where what was reckoned holds until the next.
void add_stop_odometry(const std::vector<Pose2>& reckoned, const DriveOptions& options,
                       std::uint64_t seed, Recording& recording) {
  const double end = recording.truth.back().stamp;
  const OdometryArrival arrival(options.faults, 0.0, end, seed);
  const auto at = [&](double t) {
    const auto stop = static_cast<std::size_t>(std::floor(t / options.stop_interval_s + 1e-9));
    return reckoned[std::min(stop, reckoned.size() - 1)];
  };
  for (const StampedPose& truth : recording.truth) {
    add_scan_odometry(arrival.pose(truth.stamp, at), arrival.is_lost(truth.stamp), recording);
  }
}

/// From the time on at which a scanner fails, each of its scans has the ranges of its last.
void repeat_scans(const ScannerFaults& faults, std::span<LaserScan> scans) {
  if (faults.repeat_after_s < 0.0) return;
  for (std::size_t i = 1; i < scans.size(); ++i) {
    const double since = scans[i].stamp - faults.repeat_after_s;
    const bool repeats = since >= 0.0 && (faults.repeat_s <= 0.0 || since < faults.repeat_s);
    if (repeats) scans[i].ranges = scans[i - 1].ranges;
  }
}

/// The scans of one of several scanners, whose sweeps begin one after the other.
std::vector<LaserScan> scans_of(int scanner, std::span<const ScannerSpec> scanners,
                                const World& world, const TimedPath& truth,
                                const DriveOptions& options, std::uint64_t seed) {
  const ScannerSpec& spec = scanners[static_cast<std::size_t>(scanner)];
  const RayCaster fixed(fixed_segments(world));
  const double offset = scanner / (options.scan_rate_hz * static_cast<double>(scanners.size()));
  Random random(seed, kScans + kNextScanner * static_cast<std::uint64_t>(scanner));
  std::vector<LaserScan> scans;
  for (const double stamp : scan_stamps(truth, spec, offset, options.scan_rate_hz)) {
    scans.push_back(simulate_sweep(fixed, truth, stamp, spec, random,
                                   passing_segments(world, {stamp, truth.at(stamp)})));
    scans.back().scanner = scanner;
  }
  repeat_scans(spec.faults, scans);
  return scans;
}

}  // namespace

OdometryNoise mockup_odometry() {
  return {.translation_sigma_ratio = 0.05,
          .rotation_sigma_rad_per_m = radians(2.0) / 1.6,
          .rotation_sigma_ratio = 0.0,
          .translation_floor_m = 0.0,
          .rotation_floor_rad = 0.0};
}

std::optional<Pose2> Recording::odometry_at(std::size_t scan) const {
  const bool is_missing = !is_without_odometry.empty() && is_without_odometry[scan];
  return is_missing ? std::nullopt : std::optional(odometry[scan]);
}

Recording record_stops(const World& world, std::span<const Pose2> stops, const ScannerSpec& spec,
                       const DriveOptions& options, std::uint64_t seed) {
  Recording recording;
  if (stops.empty()) return recording;
  const RayCaster fixed(fixed_segments(world));
  const std::vector<Pose2> hops = hops_at_stops(stops.size(), options, seed);
  Random scans(seed, kScans);
  Random wheels(seed, kWheels);
  SlipBursts bursts(options.faults, seed);
  recording.first_guess = draw_first_guess(stops.front(), options, seed);
  std::vector<Pose2> reckoned;
  for (std::size_t i = 0; i < stops.size(); ++i) {
    if (i == 0) {
      reckoned.push_back(recording.first_guess.pose);
    } else {
      const Pose2 move = inverse(recording.truth.back().pose) * stops[i];
      const Vector3d error = draw_move_error(move, options.odometry, wheels);
      const double slip = options.slip_ratio + bursts.slip_over(move.translation().norm());
      reckoned.push_back(reckoned.back() * reported_move(move, slip, error, options.faults));
    }
    const double stamp = options.stop_interval_s * static_cast<double>(i);
    recording.truth.push_back({stamp, stops[i] * hops[i]});
    const StampedPose& truth = recording.truth.back();
    LaserScan scan = simulate_scan(fixed, truth.pose, spec, scans, passing_segments(world, truth));
    scan.stamp = stamp;
    recording.scans.push_back(std::move(scan));
  }
  repeat_scans(spec.faults, recording.scans);
  add_stop_odometry(reckoned, options, seed, recording);
  add_gyro(recording, options, seed);
  return recording;
}

Recording record_drive(const World& world, std::span<const Pose2> path, const ScannerSpec& spec,
                       const DriveOptions& options, std::uint64_t seed) {
  return record_drive(world, drive_along(path, options.speed_m_per_s, options.turn_rate_rad_per_s),
                      std::span(&spec, 1), options, seed);
}

Recording record_drive(const World& world, const TimedPath& path,
                       std::span<const ScannerSpec> scanners, const DriveOptions& options,
                       std::uint64_t seed) {
  Recording recording;
  if (path.knots.empty() || scanners.empty()) return recording;
  const TimedPath truth = add_hops(path, options, seed);
  for (std::size_t scanner = 0; scanner < scanners.size(); ++scanner) {
    std::vector<LaserScan> scans =
        scans_of(static_cast<int>(scanner), scanners, world, truth, options, seed);
    std::move(scans.begin(), scans.end(), std::back_inserter(recording.scans));
  }
  std::stable_sort(recording.scans.begin(), recording.scans.end(),
                   [](const LaserScan& a, const LaserScan& b) { return a.stamp < b.stamp; });
  for (const LaserScan& scan : recording.scans) {
    recording.truth.push_back({scan.stamp, truth.at(scan.stamp)});
  }
  recording.first_guess = draw_first_guess(recording.truth.front().pose, options, seed);
  add_odometry(without_jumps(truth), options, seed, recording);
  add_gyro(recording, options, seed);
  return recording;
}

}  // namespace adit
