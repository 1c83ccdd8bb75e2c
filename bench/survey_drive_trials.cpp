// Surveys simulated drives through mines and prints what docs/benchmarks.md says of them: the error
// of the trajectory, of the steps from keyframe to keyframe as tracked, and closures that are
// false.
//
//   survey_drive_trials WORLD SCANNER LENGTH_M SEED...
//
// WORLD is `panel`, `drift`, or the name of a mine in the folder that ADIT_DATA names (else
// ../shared/data): `niosh`, `edgar`. A drive through a mine leads over places chosen at random,
// back to where it began and a part of the way once more.

#include <fmt/core.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <limits>
#include <queue>
#include <string>
#include <utility>
#include <vector>

#include "adit/calibration/log_settings.hpp"
#include "adit/io/carmen.hpp"
#include "adit/io/plan.hpp"
#include "adit/io/trajectory.hpp"
#include "adit/simulation/clutter.hpp"
#include "adit/simulation/mine_worlds.hpp"
#include "adit/simulation/vehicle.hpp"
#include "adit/survey/drive_survey.hpp"

namespace adit {
namespace {

constexpr int kClutter = 5;
constexpr int kThreads = 1;
constexpr double kFalseMetres = 0.3;
constexpr double kFalseRadians = 0.1;

/// Places in a mine, and which of them a machine may drive between in a straight line.
class RoadMap {
 public:
  RoadMap(const std::vector<Segment>& walls, const std::vector<StampedPose>& places) {
    for (const StampedPose& p : places) places_.push_back(p.pose.translation());
    roads_.resize(places_.size());
    for (std::size_t i = 0; i < places_.size(); ++i) {
      for (std::size_t j = 0; j < i; ++j) {
        const Segment way{places_[i], places_[j]};
        if (way.length() > kLongest || !is_clear(walls, way)) continue;
        roads_[i].push_back(j);
        roads_[j].push_back(i);
      }
    }
  }

  std::size_t size() const { return places_.size(); }
  const Vector2d& place(std::size_t i) const { return places_[i]; }

  /// The shortest way; empty where there is none.
  std::vector<std::size_t> way(std::size_t from, std::size_t to) const {
    using Entry = std::pair<double, std::size_t>;
    std::vector<double> length(places_.size(), std::numeric_limits<double>::infinity());
    std::vector<std::size_t> before(places_.size(), from);
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
    length[from] = 0.0;
    queue.emplace(0.0, from);
    while (!queue.empty() && queue.top().second != to) {
      const auto [done, i] = queue.top();
      queue.pop();
      if (done > length[i]) continue;
      for (const std::size_t j : roads_[i]) {
        const double next = done + (places_[i] - places_[j]).norm();
        if (next >= length[j]) continue;
        length[j] = next;
        before[j] = i;
        queue.emplace(next, j);
      }
    }
    if (queue.empty()) return {};
    std::vector<std::size_t> out;
    for (std::size_t i = to; i != from; i = before[i]) out.push_back(i);
    out.push_back(from);
    std::reverse(out.begin(), out.end());
    return out;
  }

 private:
  static constexpr double kLongest = 10.0;   // m
  static constexpr double kClearance = 0.6;  // m

  static bool is_clear(const std::vector<Segment>& walls, const Segment& way) {
    const Vector2d middle = 0.5 * (way.a + way.b);
    for (const Segment& wall : walls) {
      const double reach = 0.5 * (way.length() + wall.length()) + kClearance;
      if ((0.5 * (wall.a + wall.b) - middle).squaredNorm() > reach * reach) continue;
      if (distance(wall, way.a) < kClearance || distance(wall, way.b) < kClearance) return false;
      if (distance(way, wall.a) < kClearance || distance(way, wall.b) < kClearance) return false;
      const auto side = [](const Segment& s, const Vector2d& p) {
        return cross(s.b - s.a, p - s.a);
      };
      if (side(wall, way.a) * side(wall, way.b) < 0.0 &&
          side(way, wall.a) * side(way, wall.b) < 0.0) {
        return false;
      }
    }
    return true;
  }

  std::vector<Vector2d> places_;
  std::vector<std::vector<std::size_t>> roads_;
};

double length_of(const RoadMap& roads, const std::vector<std::size_t>& route) {
  double length = 0.0;
  for (std::size_t i = 1; i < route.size(); ++i) {
    length += (roads.place(route[i]) - roads.place(route[i - 1])).norm();
  }
  return length;
}

/// Away over two thirds of the length, back, and the first part of the way again.
std::vector<std::size_t> route_through(const RoadMap& roads, double length_m, Random& random) {
  const auto draw = [&] {
    return static_cast<std::size_t>(random.below(static_cast<int>(roads.size())));
  };
  std::vector<std::size_t> route;
  for (int tries = 0; tries < 1000 && length_of(roads, route) < 0.6 * length_m; ++tries) {
    if (route.empty()) route.push_back(draw());
    const auto leg = roads.way(route.back(), draw());
    if (leg.size() < 2 || length_of(roads, leg) > 0.5 * length_m) {
      if (tries % 20 == 19) route.clear();  // a place from which nothing is to be reached
      continue;
    }
    route.insert(route.end(), leg.begin() + 1, leg.end());
  }
  if (route.size() < 2) return {};
  const auto back = roads.way(route.back(), route.front());
  const std::size_t again = route.size() / 4;
  route.insert(route.end(), back.begin() + 1, back.end());
  route.insert(route.end(), route.begin() + 1, route.begin() + 1 + static_cast<long>(again));
  return route;
}

/// Looks along the way, and turns where it bends.
std::vector<Pose2> poses_along(const RoadMap& roads, const std::vector<std::size_t>& route) {
  std::vector<Pose2> poses;
  for (std::size_t i = 1; i < route.size(); ++i) {
    const Vector2d& a = roads.place(route[i - 1]);
    const Vector2d& b = roads.place(route[i]);
    if ((b - a).norm() < 1e-6) continue;
    const double heading = std::atan2(b.y() - a.y(), b.x() - a.x());
    poses.push_back({a.x(), a.y(), heading});
    poses.push_back({b.x(), b.y(), heading});
  }
  return poses;
}

Result<World> mine(const std::string& name, double length_m, std::uint64_t seed) {
  const char* const named = std::getenv("ADIT_DATA");
  const std::string base = std::string(named != nullptr ? named : "../shared/data") + "/mines/";
  auto plan = read_plan(base + name + ".csv");
  if (!plan) return tl::unexpected(plan.error());
  const auto places = read_trajectory(base + name + "_poses.tum");
  if (!places) return tl::unexpected(places.error());
  const RoadMap roads(plan->segments, *places);
  Random random(seed, 4711);
  World world = from_plan(std::move(plan->segments));
  world.path = poses_along(roads, route_through(roads, length_m, random));
  if (world.path.empty()) return fail("no way was found", name);
  return world;
}

Result<World> world_named(const std::string& name, double length_m, std::uint64_t seed) {
  if (name == "panel") return panel({}, seed);
  if (name == "drift") return drift({}, seed);
  return mine(name, length_m, seed);
}

/// As `adit simulate` writes it and `adit survey` reads it.
Result<Log> log_of(const Recording& recording) {
  Log log;
  for (std::size_t i = 0; i < recording.scans.size(); ++i) {
    LogScan scan;
    scan.scan = recording.scans[i];
    scan.odom_from_vehicle = recording.odometry[i];
    log.scans.push_back(std::move(scan));
  }
  return parse_log(format_carmen(log));
}

struct StepError {
  double metres = 0.0;
  double radians = 0.0;
  bool is_false() const { return metres > kFalseMetres || radians > kFalseRadians; }
};

StepError step_error(const Recording& drive, std::size_t from, std::size_t to, const Pose2& step) {
  const Pose2 truth = inverse(drive.truth[from].pose) * drive.truth[to].pose;
  const Vector3d off = difference(truth, step);
  return {off.head<2>().norm(), std::abs(off.z())};
}

/// Absolute error after the rigid motion that fits best (Umeyama 1991), root mean square and worst.
std::pair<double, double> absolute_error(const Recording& drive, const DriveResult& result) {
  Vector2d middle = Vector2d::Zero();
  Vector2d true_middle = Vector2d::Zero();
  const double n = static_cast<double>(result.poses.size());
  for (std::size_t i = 0; i < result.poses.size(); ++i) {
    middle += result.poses[i].map_from_vehicle.translation() / n;
    true_middle += drive.truth[i].pose.translation() / n;
  }
  double dots = 0.0;
  double crosses = 0.0;
  for (std::size_t i = 0; i < result.poses.size(); ++i) {
    const Vector2d a = result.poses[i].map_from_vehicle.translation() - middle;
    const Vector2d b = drive.truth[i].pose.translation() - true_middle;
    dots += a.dot(b);
    crosses += cross(a, b);
  }
  const RigidTransform turn(Pose2{0.0, 0.0, std::atan2(crosses, dots)});
  double sum = 0.0;
  double worst = 0.0;
  for (std::size_t i = 0; i < result.poses.size(); ++i) {
    const Vector2d a = turn.direction(result.poses[i].map_from_vehicle.translation() - middle);
    const double error = (a - (drive.truth[i].pose.translation() - true_middle)).norm();
    sum += error * error;
    worst = std::max(worst, error);
  }
  return {std::sqrt(sum / n), worst};
}

/// The worst of the steps from keyframe to keyframe as tracked, and how many are false.
void print_tracking(const Recording& drive, const ScanTracker& tracker) {
  StepError worst;
  std::size_t at = 0;
  int wrong = 0;
  const auto& keyframes = tracker.keyframes();
  for (std::size_t i = 1; i < keyframes.size(); ++i) {
    const StepError e = step_error(drive, keyframes[i - 1].scan, keyframes[i].scan,
                                   keyframes[i].previous_from_this);
    wrong += e.is_false();
    if (e.metres <= worst.metres) continue;
    worst = e;
    at = keyframes[i].scan;
  }
  fmt::print(" | tracked: {} false, worst {:.3f} m {:.2f} deg at scan {}", wrong, worst.metres,
             degrees(worst.radians), at);
}

void print_result(const Recording& drive, const DriveResult& result) {
  constexpr std::size_t kSecond = 5;  // scans
  StepError sum;
  double worst = 0.0;
  std::size_t count = 0;
  for (std::size_t i = 0; i + kSecond < result.poses.size(); ++i, ++count) {
    const Pose2 step =
        inverse(result.poses[i].map_from_vehicle) * result.poses[i + kSecond].map_from_vehicle;
    const StepError e = step_error(drive, i, i + kSecond, step);
    sum.metres += e.metres;
    sum.radians += e.radians;
    worst = std::max(worst, e.metres);
  }
  int wrong = 0;
  for (const Closure& c : result.closures) {
    wrong +=
        step_error(drive, result.keyframes[c.from], result.keyframes[c.to], c.from_to).is_false();
  }
  const auto [rms, most] = absolute_error(drive, result);
  const double n = static_cast<double>(std::max<std::size_t>(1, count));
  fmt::print(
      " | 1 s: {:.4f} m {:.3f} deg, worst {:.3f} | ATE {:.4f} max {:.3f} m | closures {}, false {}",
      sum.metres / n, degrees(sum.radians / n), worst, rms, most, result.closures.size(), wrong);
}

Result<void> run(const std::string& name, const ScannerSpec& spec, double length_m,
                 std::uint64_t seed) {
  auto world = world_named(name, length_m, seed);
  if (!world) return tl::unexpected(world.error());
  add_clutter(*world, clutter_of(kClutter), seed);
  const Recording drive = record_drive(*world, world->path, spec, {}, seed);
  const auto log = log_of(drive);
  if (!log) return tl::unexpected(log.error());
  const Configuration values = settle({}, *log).configuration;
  const auto start = std::chrono::steady_clock::now();
  DriveSurvey survey(values.localizer.odometry, values.drive);
  ScanTracker tracker(values.localizer.odometry, values.drive.tracking, values.drive.surface,
                      values.drive.alignment);
  for (const LogScan& entry : log->scans) {
    survey.add(entry.scan, values.localizer.scanner, entry.odom_from_vehicle);
    tracker.add(entry.scan, values.localizer.scanner, entry.odom_from_vehicle);
  }
  const auto finished = survey.finish(kThreads);
  if (!finished) return tl::unexpected(finished.error());
  const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - start;
  fmt::print("{} seed {} scans {} {:.0f} s", name, seed, log->scans.size(), taken.count());
  print_tracking(drive, tracker);
  print_result(drive, *finished);
  fmt::print("\n");
  std::fflush(stdout);
  return {};
}

}  // namespace
}  // namespace adit

int main(int argc, char** argv) {
  const auto spec = argc > 4 ? adit::scanner_named(argv[2]) : std::nullopt;
  if (!spec) {
    fmt::print(stderr, "survey_drive_trials panel|drift|niosh|edgar SCANNER LENGTH_M SEED...\n");
    return 2;
  }
  for (int i = 4; i < argc; ++i) {
    const auto done =
        adit::run(argv[1], *spec, std::atof(argv[3]), std::strtoull(argv[i], nullptr, 10));
    if (done) continue;
    fmt::print(stderr, "{}\n", to_string(done.error()));
    return 1;
  }
  return 0;
}
