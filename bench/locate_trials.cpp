// One scan, no prior: where in the mine was it taken? Prints the figures of docs/benchmarks.md: how
// often the true pose comes first, is listed, is stated as `ok`; how long the search takes; time
// and memory of the index.
//
//   locate_trials [name=value]...

#include <fmt/core.h>

#include <algorithm>
#include <ctime>
#include <fstream>
#include <map>

#include "adit/evaluation/statistics.hpp"
#include "adit/places/place_file.hpp"
#include "adit/relocation/relocator.hpp"
#include "adit/threads/share_out.hpp"
#include "locate_oracle.hpp"
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
    return percentile(seconds, part);
  }

  void print_shares(const char* what) const {
    const auto share = [&](const char* name, int count) {
      fmt::print("  {} {} ({:.1f} %)", name, count, 100.0 * count / std::max(1, scans));
    };
    fmt::print("{} {}", what, scans);
    share("first", first);
    share("listed", listed);
    share("ok", ok);
    fmt::print("  ok_wrong {}  degraded_wrong {}\n", ok_wrong, degraded_wrong);
  }

  void print() {
    print_shares("scans");
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

/// The figures of those scans that allow one answer, by two measures: poses that differ by the
/// scanner's noise alone, and by what is stated of the plan as well.
class OracleTally {
 public:
  OracleTally(const LocateScene& scene, const LocateOptions& options)
      : scene_(scene), oracle_(scene.map, scene.scanner, inside(scene), cores()) {
    fmt::print("oracle places {}  of {} scans\n", oracle_.size(), options.oracle);
  }

  void add(const LocateCase& one, const RelocationResult& result) {
    if (!one.truth) return;
    const std::clock_t start = std::clock();
    oracle_.rate(one.scan);
    MapError drawn = scene_.map_error;
    drawn.offset_sigma_m = drawn.roughness_sigma_m = 0.0;
    const OracleAnswer by_noise = oracle_.judge(one.scan, *one.truth, drawn);
    const OracleAnswer by_plan = oracle_.judge(one.scan, *one.truth, scene_.map_error);
    const double elapsed = cpu_seconds_since(start);
    all_.add(result, one.truth, elapsed);
    if (by_noise.one_answer) by_noise_.add(result, one.truth, elapsed);
    if (by_plan.one_answer) by_plan_.add(result, one.truth, elapsed);
    found_ += by_noise.found_truth && by_plan.found_truth;
    print_miss(by_noise, by_plan, result, one.truth);
  }

  void print() {
    fmt::print("oracle examined {}  found the true pose itself {}  cpu_s median {:.1f}\n",
               all_.scans, found_, all_.quantile(0.5));
    all_.print_shares("examined");
    by_noise_.print_shares("one_answer_by_noise");
    by_plan_.print_shares("one_answer_by_stated_error");
  }

 private:
  static std::vector<Vector2d> inside(const LocateScene& scene) {
    std::vector<Vector2d> places;
    for (const LocateCase& one : scene.cases) {
      if (one.truth) places.push_back(one.truth->translation());
    }
    return places;
  }
  static int cores() { return threads_or_cores(0); }

  void print_miss(const OracleAnswer& by_noise, const OracleAnswer& by_plan,
                  const RelocationResult& result, const std::optional<Pose2>& truth) const {
    const bool right = !result.poses.empty() && is_right(result.poses.front(), truth);
    if (right && result.verdict == Status::ok) return;
    fmt::print(
        "scan {} {} {}  gap by noise {:.1f}  by stated error {:.1f}  rival {:.2f} {:.2f} {:.2f}\n",
        all_.scans - 1, right ? "right" : "wrong", to_string(result.verdict), by_noise.gap,
        by_plan.gap, by_plan.rival.x, by_plan.rival.y, by_plan.rival.theta);
  }

  const LocateScene& scene_;
  PoseOracle oracle_;
  Tally all_;
  Tally by_noise_;
  Tally by_plan_;
  int found_ = 0;
};

void describe(std::size_t number, const LocateScene& scene, const RelocationResult& result) {
  const std::optional<Pose2>& truth = scene.cases[number].truth;
  const BeamShares& shares = result.shares;
  fmt::print(
      "scan {} {}  map error {:.3f} m  gap {:.1f}  on wall {:.3f} before {:.3f} through {:.3f} "
      "unmapped {:.3f} missing {:.3f}",
      number, to_string(result.verdict), result.map_error.sigma_m(), result.gap, shares.on_wall,
      shares.before, shares.through, shares.unmapped, shares.missing);
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

/// Read from the file where it holds one of this plan, else built and saved there.
PlaceIndex index_of(const LineMap& map, const LocateOptions& options) {
  if (!options.index.empty()) {
    std::ifstream in(options.index, std::ios::binary);
    auto read = read_places(map, {}, in);
    if (read && *read) return std::move(**read);
  }
  PlaceIndex index = PlaceIndex::build(map, {}, options.threads);
  if (!options.index.empty()) {
    std::ofstream out(options.index, std::ios::binary);
    if (const auto written = write_places(index, map, {}, out); !written) {
      fmt::print(stderr, "{}\n", to_string(written.error()));
    }
  }
  return index;
}

int run(const LocateOptions& options) {
  const auto scene = make_locate_scene(options);
  if (!scene) {
    fmt::print(stderr, "{}\n", to_string(scene.error()));
    return 1;
  }
  std::clock_t start = std::clock();
  const PlaceIndex index = index_of(scene->map, options);
  fmt::print("plan {}  segments {}  places {}  pitch {:.2f} m  index_cpu {:.2f} s  {:.1f} MB\n",
             options.plan, scene->map.walls().size(), index.size(), index.pitch_m(),
             cpu_seconds_since(start), 1e-6 * static_cast<double>(index.memory()));
  Relocator relocator(scene->map, index);
  Tally tally;
  std::optional<OracleTally> oracle;
  if (options.oracle > 0) oracle.emplace(*scene, options);
  int shown = 0;
  for (std::size_t i = 0; i < scene->cases.size(); ++i) {
    const LocateCase& one = scene->cases[i];
    start = std::clock();
    const RelocationResult& result =
        relocator.locate({one.scan, scene->scanner, scene->map_error, {}, {}});
    tally.add(result, one.truth, cpu_seconds_since(start));
    if (static_cast<int>(i) < options.oracle) oracle->add(one, result);
    const bool right = !result.poses.empty() && is_right(result.poses.front(), one.truth);
    const bool sure = result.verdict == Status::ok || result.verdict == Status::degraded;
    const bool asked = (!(right && sure) || options.worst > options.count) && shown < options.worst;
    shown += asked;
    if (asked || (sure && !right)) describe(i, *scene, result);
  }
  tally.print();
  if (oracle) oracle->print();
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
