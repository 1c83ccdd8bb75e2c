// One scan, no prior: where in the mine was it taken? Prints the figures of docs/benchmarks.md: how
// often the true pose comes first, is listed, is stated as `ok`; how long the search takes; time
// and memory of the index.
//
//   locate_trials [name=value]...

#include <fmt/core.h>

#include <algorithm>
#include <ctime>
#include <map>

#include "adit/relocation/relocator.hpp"
#include "locate_scene.hpp"

namespace adit {
namespace {

constexpr double kRightMetres = 1.0;
constexpr double kRightRadians = radians(5.0);

/// Of all cores together, so that what else the machine does is not counted.
double cpu_seconds_since(std::clock_t start) {
  return static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
}

bool is_right(const RankedPose& pose, const std::optional<Pose2>& truth) {
  if (!truth) return false;
  const Vector3d off = difference(*truth, pose.pose);
  return off.head<2>().norm() <= kRightMetres && std::abs(off.z()) <= kRightRadians;
}

struct Tally {
  int scans = 0;
  int first = 0;
  int listed = 0;
  int ok = 0;
  int ok_wrong = 0;
  int degraded_wrong = 0;
  std::map<Status, int> verdicts;
  std::vector<double> seconds;

  void add(const RelocationResult& result, const std::optional<Pose2>& truth, double elapsed) {
    ++scans;
    ++verdicts[result.verdict];
    seconds.push_back(elapsed);
    const bool right = !result.poses.empty() && is_right(result.poses.front(), truth);
    first += right;
    listed += std::any_of(result.poses.begin(), result.poses.end(),
                          [&](const RankedPose& pose) { return is_right(pose, truth); });
    ok += right && result.verdict == Status::ok;
    ok_wrong += !right && result.verdict == Status::ok;
    degraded_wrong += !right && result.verdict == Status::degraded;
  }

  double quantile(double part) {
    if (seconds.empty()) return 0.0;
    std::sort(seconds.begin(), seconds.end());
    return seconds[static_cast<std::size_t>(part * static_cast<double>(seconds.size() - 1))];
  }

  void print() {
    const auto percent = [&](int count) { return 100.0 * count / std::max(1, scans); };
    fmt::print(
        "scans {}  first {:.1f} %  listed {:.1f} %  ok {:.1f} %  ok_wrong {}  "
        "degraded_wrong {}\n",
        scans, percent(first), percent(listed), percent(ok), ok_wrong, degraded_wrong);
    fmt::print("verdicts");
    for (const auto& [status, count] : verdicts) fmt::print("  {} {}", to_string(status), count);
    fmt::print("\nsearch_cpu_ms median {:.1f}  p95 {:.1f}  max {:.1f}\n", 1e3 * quantile(0.5),
               1e3 * quantile(0.95), 1e3 * quantile(1.0));
  }
};

/// How likely the scan is from where it was taken: above what was found, the search has missed it.
double likelihood_at_truth(const LocateScene& scene, const LocateCase& one,
                           const MapError& map_error) {
  constexpr double kDoubt = 0.02;  // m
  ScanLikelihood likelihood;
  likelihood.set_scan(one.scan, scene.scanner, map_error, {});
  return likelihood.at(scene.map, *one.truth * one.scan.vehicle_from_laser, kDoubt);
}

void describe(std::size_t number, const LocateScene& scene, const RelocationResult& result) {
  const std::optional<Pose2>& truth = scene.cases[number].truth;
  fmt::print("scan {} {}  map error {:.3f} m", number, to_string(result.verdict),
             result.map_error.sigma_m());
  if (truth) {
    fmt::print("  truth {:.2f} {:.2f} {:.2f} log {:.1f}", truth->x, truth->y, truth->theta,
               likelihood_at_truth(scene, scene.cases[number], result.map_error));
  }
  fmt::print("\n");
  for (std::size_t i = 0; i < std::min<std::size_t>(4, result.poses.size()); ++i) {
    const RankedPose& pose = result.poses[i];
    fmt::print(
        "   {:.2f} {:.2f} {:.2f} weight {:.2g} log {:.1f} evidence {:.2f} wall {:.2f} "
        "behind {:.2f}{}\n",
        pose.pose.x, pose.pose.y, pose.pose.theta, pose.weight, pose.log_likelihood,
        pose.quality.evidence_ratio, pose.quality.wall_ratio, pose.quality.behind_ratio,
        is_right(pose, truth) ? " right" : "");
  }
}

int run(const LocateOptions& options) {
  const auto scene = make_locate_scene(options);
  if (!scene) {
    fmt::print(stderr, "{}\n", to_string(scene.error()));
    return 1;
  }
  std::clock_t start = std::clock();
  const PlaceIndex index = PlaceIndex::build(scene->map, {}, options.threads);
  fmt::print("plan {}  segments {}  places {}  pitch {:.2f} m  index_cpu {:.2f} s  {:.1f} MB\n",
             options.plan, scene->map.walls().size(), index.size(), index.pitch_m(),
             cpu_seconds_since(start), 1e-6 * static_cast<double>(index.memory()));
  Relocator relocator(scene->map, index);
  Tally tally;
  int shown = 0;
  for (std::size_t i = 0; i < scene->cases.size(); ++i) {
    const LocateCase& one = scene->cases[i];
    start = std::clock();
    const RelocationResult& result =
        relocator.locate({one.scan, scene->scanner, scene->map_error, {}, {}});
    tally.add(result, one.truth, cpu_seconds_since(start));
    const bool right = !result.poses.empty() && is_right(result.poses.front(), one.truth);
    const bool sure = result.verdict == Status::ok || result.verdict == Status::degraded;
    const bool asked = (!(right && sure) || options.worst > options.count) && shown < options.worst;
    shown += asked;
    if (asked || (sure && !right)) describe(i, *scene, result);
  }
  tally.print();
  return 0;
}

}  // namespace
}  // namespace adit

int main(int argc, char** argv) {
  const auto options =
      adit::parse_locate({argv + 1, static_cast<std::size_t>(std::max(0, argc - 1))});
  if (!options) {
    fmt::print(stderr, "{}\n{}", to_string(options.error()), adit::locate_usage());
    return 2;
  }
  return adit::run(*options);
}
