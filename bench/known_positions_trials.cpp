// Surveys of a rough panel from known positions (section IV-F of Shaffer et al. 1992): stations a
// metre apart, ten scans each, headings unknown, the scanner pitching and rolling between roof and
// floor, clutter that moves between the scans. How far the surveyed walls are from the true ones
// and the true ones that were in sight from the surveyed. Prints the figures of docs/benchmarks.md.
//
//   known_positions_trials [scanner = cyclone] [spacing of stations, m = 1]
//     [tilt = scan | station: of each scan its own, or of the station] [seed ... = 1 2 3]

#include <fmt/core.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "adit/evaluation/statistics.hpp"
#include "adit/io/plan.hpp"
#include "adit/simulation/clutter.hpp"
#include "adit/simulation/mine_worlds.hpp"
#include "adit/simulation/tilted_scanner.hpp"
#include "adit/survey/known_positions.hpp"

namespace adit {
namespace {

constexpr int kStations = 30;
constexpr int kScans = 10;
constexpr double kTiltSigma = radians(2.0);
constexpr double kSwaySigma = radians(0.2);
constexpr double kSample = 0.05;       // m along walls
constexpr double kFoundWithin = 0.3;   // m: a true wall with no surveyed one nearer is missing
constexpr double kNearHit = 0.15;      // m along the true wall on both sides of a beam's end ...
constexpr int kEndsInSight = 5;        // ... and so many ends put a place in sight
constexpr int kEndsInClearSight = 20;  // and so many in clear sight

struct Trial {
  World world;
  std::vector<PositionedScan> scans;
  std::vector<Pose2> truth;
  std::vector<Tilt> tilts;
  std::vector<Vector2d> samples;  // of the true walls
  std::vector<int> ends;          // of beams near each
  std::map<std::pair<long, long>, std::vector<std::size_t>> squares;
};

std::vector<Vector2d> samples_of(std::span<const Segment> segments) {
  std::vector<Vector2d> out;
  for (const Segment& s : segments) {
    const int n = std::max(1, static_cast<int>(s.length() / kSample));
    for (int i = 0; i < n; ++i) out.push_back(s.a + (i + 0.5) / n * (s.b - s.a));
  }
  return out;
}

/// Counts the ends of this scan's beams on the true walls.
void count_ends(const LaserScan& scan, const Pose2& pose, const RayCaster& walls, Trial& trial) {
  const Pose2 laser = pose * scan.vehicle_from_laser;
  for (std::size_t i = 0; i < scan.ranges.size(); ++i) {
    if (!scan.has_return(i)) continue;
    const Vector2d way = unit_vector(laser.theta + scan.bearing(i));
    const double range = walls.range(laser.translation(), way);
    if (std::abs(range - scan.ranges[i]) > 0.5) continue;  // roof, floor or clutter
    const Vector2d end = laser.translation() + range * way;
    const auto x = static_cast<long>(std::floor(end.x() / kNearHit));
    const auto y = static_cast<long>(std::floor(end.y() / kNearHit));
    for (long dx = -1; dx <= 1; ++dx) {
      for (long dy = -1; dy <= 1; ++dy) {
        const auto square = trial.squares.find({x + dx, y + dy});
        if (square == trial.squares.end()) continue;
        for (const std::size_t k : square->second) {
          if ((trial.samples[k] - end).squaredNorm() < kNearHit * kNearHit) ++trial.ends[k];
        }
      }
    }
  }
}

/// A scanner that is set up anew for each scan, or stands at a station's tilt and sways a little.
Tilt tilt_of_scan(const Tilt& station, bool by_station, Random& random) {
  const double sigma = by_station ? kSwaySigma : kTiltSigma;
  const Tilt sway{sigma * random.normal(), sigma * random.normal()};
  if (!by_station) return sway;
  return {station.pitch_rad + sway.pitch_rad, station.roll_rad + sway.roll_rad};
}

/// What stands or moves near the pose, other in each scan, and what stays a while.
std::vector<Segment> things_near(const World& world, const Pose2& pose, std::uint64_t staying,
                                 std::uint64_t moving) {
  World stays = world;
  stays.path = {pose};
  World moves = stays;
  add_clutter(stays, clutter_of(5), staying);
  add_clutter(moves, clutter_of(5), moving);
  std::vector<Segment> things = moves.clutter;
  const auto people = people_at(moves, 0.0);
  things.insert(things.end(), people.begin(), people.end());
  things.insert(things.end(), stays.clutter.begin(), stays.clutter.end());
  return things;
}

/// The true walls in places, to count the ends of beams on them.
void sample_walls(Trial& trial) {
  trial.samples = samples_of(trial.world.walls);
  trial.ends.assign(trial.samples.size(), 0);
  for (std::size_t k = 0; k < trial.samples.size(); ++k) {
    const Vector2d square = (trial.samples[k] / kNearHit).array().floor();
    trial.squares[{static_cast<long>(square.x()), static_cast<long>(square.y())}].push_back(k);
  }
}

Trial make_trial(const ScannerSpec& spec, double spacing, bool by_station, std::uint64_t seed) {
  PanelOptions panel_options;
  panel_options.path_step_m = spacing;
  Trial trial;
  trial.world = panel(panel_options, seed);
  sample_walls(trial);
  Random random(seed, 77);
  const RayCaster walls(trial.world.walls);
  const std::size_t stations = std::min<std::size_t>(kStations, trial.world.path.size());
  trial.world.path.resize(stations);
  double stamp = 0.0;
  for (std::size_t s = 0; s < stations; ++s) {
    Pose2 pose = trial.world.path[s];
    pose.theta = random.uniform(-kPi, kPi);
    const Tilt station{kTiltSigma * random.normal(), kTiltSigma * random.normal()};
    for (std::uint64_t k = 0; k < kScans; ++k) {
      const std::uint64_t base = seed * 1000003;
      const std::vector<Segment> things =
          things_near(trial.world, pose, base + s / 3, base + 1000 + s * 10 + k);
      const Tilt tilt = tilt_of_scan(station, by_station, random);
      LaserScan scan = simulate_tilted_scan(walls, pose, spec, tilt, {}, random, things);
      scan.stamp = stamp;
      count_ends(scan, pose, walls, trial);
      stamp += 1.0;
      trial.scans.push_back({std::move(scan), pose.translation(), std::nullopt});
      trial.truth.push_back(pose);
      trial.tilts.push_back(tilt);
    }
  }
  return trial;
}

double quantile(std::vector<double> values, double share) {
  if (values.empty()) return 0.0;
  std::sort(values.begin(), values.end());
  return percentile(values, share);
}

double nearest(std::span<const Segment> segments, const Vector2d& p) {
  double least = 1e9;
  for (const Segment& s : segments) least = std::min(least, distance(s, p));
  return least;
}

/// Where true walls were in sight and none was surveyed, as short segments.
std::vector<Segment> missing_walls(const Trial& trial, std::span<const Segment> walls) {
  std::vector<Segment> missing;
  const Vector2d half(0.4 * kSample, 0.0);
  for (std::size_t i = 0; i < trial.samples.size(); ++i) {
    const Vector2d& p = trial.samples[i];
    if (trial.ends[i] < kEndsInSight || nearest(walls, p) < kFoundWithin) continue;
    missing.push_back({p - half, p + half});
  }
  return missing;
}

void report(const Trial& trial, const KnownPositionsSurvey& survey, double seconds,
            std::uint64_t seed) {
  const std::vector<Segment> walls = survey.walls.segments();
  std::vector<double> to_truth, from_truth, headings, tilts;
  double found = 0.0, seen = 0.0, clearly_found = 0.0, clearly_seen = 0.0;
  for (const Vector2d& p : samples_of(walls)) to_truth.push_back(nearest(trial.world.walls, p));
  for (std::size_t i = 0; i < trial.samples.size(); ++i) {
    if (trial.ends[i] < kEndsInSight) continue;
    const double d = nearest(walls, trial.samples[i]);
    seen += 1.0;
    found += d < kFoundWithin ? 1.0 : 0.0;
    if (trial.ends[i] >= kEndsInClearSight) {
      clearly_seen += 1.0;
      clearly_found += d < kFoundWithin ? 1.0 : 0.0;
    }
    from_truth.push_back(d);
  }
  for (std::size_t i = 0; i < trial.truth.size(); ++i) {
    headings.push_back(degrees(
        std::abs(angle_between(survey.scans[i].map_from_vehicle.theta, trial.truth[i].theta))));
    tilts.push_back(degrees(std::hypot(survey.scans[i].tilt.pitch_rad - trial.tilts[i].pitch_rad,
                                       survey.scans[i].tilt.roll_rad - trial.tilts[i].roll_rad)));
  }
  fmt::print(
      "seed {}: to truth median {:.3f} p95 {:.3f} max {:.2f} m; back median {:.3f} p95 {:.3f} m; "
      "found {:.1f} % of {:.0f} m in sight, {:.1f} % of {:.0f} m in clear sight; heading median "
      "{:.2f} max {:.2f} deg; tilt median {:.2f} p95 "
      "{:.2f} deg; {} segments; {:.1f} s\n",
      seed, quantile(to_truth, 0.5), quantile(to_truth, 0.95), quantile(to_truth, 1.0),
      quantile(from_truth, 0.5), quantile(from_truth, 0.95), 100.0 * found / seen, seen * kSample,
      100.0 * clearly_found / clearly_seen, clearly_seen * kSample, quantile(headings, 0.5),
      quantile(headings, 1.0), quantile(tilts, 0.5), quantile(tilts, 0.95), walls.size(), seconds);
}

int run(const ScannerSpec& spec, double spacing, bool by_station, std::uint64_t seed) {
  const Trial trial = make_trial(spec, spacing, by_station, seed);
  const auto start = std::chrono::steady_clock::now();
  KnownPositionsOptions options;
  options.tilt.roof_above_m = RoofAndFloor{}.roof_above_m;
  options.tilt.floor_below_m = RoofAndFloor{}.floor_below_m;
  const auto survey = survey_known_positions(trial.scans, spec.model, options);
  const double seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  if (!survey) {
    fmt::print(stderr, "seed {}: {}\n", seed, to_string(survey.error()));
    return 1;
  }
  report(trial, *survey, seconds, seed);
  if (const char* folder = std::getenv("ADIT_TRIALS_OUT"); folder != nullptr) {
    const std::string stem = fmt::format("{}/known_positions_{}", folder, seed);
    if (!write_plan(survey->walls.segments(), stem + "_walls.csv") ||
        !write_plan(missing_walls(trial, survey->walls.segments()), stem + "_missing.csv") ||
        !write_plan(trial.world.walls, stem + "_truth.csv")) {
      return 1;
    }
  }
  return 0;
}

}  // namespace
}  // namespace adit

int main(int argc, char** argv) {
  const auto spec = adit::scanner_named(argc > 1 ? argv[1] : "cyclone");
  const double spacing = argc > 2 ? std::atof(argv[2]) : 1.0;
  const std::string tilt = argc > 3 ? argv[3] : "scan";
  if (!spec || !(spacing > 0.0) || (tilt != "scan" && tilt != "station")) {
    fmt::print(stderr,
               "usage: known_positions_trials [scanner] [spacing, m] [scan|station] [seed ...]\n");
    return 2;
  }
  std::vector<std::uint64_t> seeds;
  for (int i = 4; i < argc; ++i) seeds.push_back(std::strtoull(argv[i], nullptr, 10));
  if (seeds.empty()) seeds = {1, 2, 3};
  int status = 0;
  for (const std::uint64_t seed : seeds) {
    status = std::max(status, adit::run(*spec, spacing, tilt == "station", seed));
  }
  return status;
}
