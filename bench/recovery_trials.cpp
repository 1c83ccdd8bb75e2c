// Drives through a mine whose middle is missing: the vehicle is carried off, or nobody says where
// it starts. How far it drives until it is `ok` and right again, and whether it is ever `ok` and
// wrong.

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <span>
#include <vector>

#include "adit/localizer/localizer.hpp"
#include "adit/relocation/fit_quality.hpp"
#include "adit/simulation/carried_off.hpp"
#include "adit/simulation/clutter.hpp"
#include "locate_options.hpp"
#include "locate_scene.hpp"

namespace adit {
namespace {

constexpr std::uint64_t kRoam = 51;  // stream of the seed
constexpr std::uint64_t kSecondRecording = 1000000007;
constexpr double kRight = 1.0;  // m
constexpr double kSoon = 10.0;
constexpr double kBefore = 15.0;
constexpr double kAfter = 40.0;

/// A drive that keeps clear of the walls: on where there is room, else towards the most of it.
std::vector<Pose2> roam(const RayCaster& caster, const Pose2& start, double metres) {
  constexpr double kStep = 0.5;
  constexpr double kLook = 15.0;
  constexpr double kAhead = 3.0;  // m of room that need no turn
  constexpr double kAside = 1.0;  // m
  std::vector<Pose2> path = {start};
  const auto room = [&](const Vector2d& from, double heading) {
    return caster.range(from, unit_vector(heading), kLook);
  };
  while (kStep * static_cast<double>(path.size()) < metres) {
    const Pose2& at = path.back();
    double best = 0.0;
    double most = -1.0;
    for (int i = -18; i <= 18; ++i) {
      const double turn = radians(5.0 * i);
      const double ahead = std::min(room(at.translation(), at.theta + turn), kLook);
      const double aside = std::min({room(at.translation(), at.theta + turn + 0.5),
                                     room(at.translation(), at.theta + turn - 0.5), 2.0 * kAside});
      const double value = std::min(ahead, kAhead) + 0.1 * ahead + aside - 0.8 * std::abs(turn);
      if (value > most) {
        most = value;
        best = turn;
      }
    }
    const double heading = wrap_angle(at.theta + std::clamp(best, -0.4, 0.4));
    const Vector2d next = at.translation() + kStep * unit_vector(heading);
    if (room(at.translation(), heading) < kStep + 0.5) {
      path.push_back({at.x, at.y, wrap_angle(at.theta + 0.4)});
      if (path.size() > 1000) break;
      continue;
    }
    path.push_back({next.x(), next.y(), heading});
  }
  return path;
}

/// What came of one drive.
struct Outcome {
  double metres_to_right = -1.0;  // `ok` and right again after so much driving; negative for never
  double metres_to_mark = 0.0;    // of them, until what tells the place from others came in sight
  int trusted = 0;
  int trusted_wrong = 0;
  int scans = 0;
};

/// Runs through the mine of a scene.
class Mine {
 public:
  Mine(const LocateScene& scene, const LocateOptions& options)
      : scene_(scene), options_(options), spec_(*scanner_named(options.scanner)) {
    world_.walls = segments();
    caster_ = RayCaster(world_.walls);
    unmarked_ = RayCaster(scene.unmarked);
    PlaceIndexOptions places;
    index_ =
        std::make_shared<const PlaceIndex>(PlaceIndex::build(scene.map, places, options.threads));
  }

  Outcome kidnapped(std::size_t run) const {
    const std::size_t n = scene_.cases.size();
    const Pose2& from = *scene_.cases[run % n].truth;
    std::size_t other = (run + n / 2) % n;
    for (std::size_t tried = 0; tried < n; ++tried) {
      if ((scene_.cases[other].truth->translation() - from.translation()).norm() >= 10.0) break;
      other = (other + 1) % n;
    }
    const std::uint64_t seed = options_.seed + run;
    Recording first = record(roam(caster_, from, kBefore), seed);
    const std::size_t parted = first.scans.size();
    const Recording second = record(way_from(other), seed + kSecondRecording);
    const Pose2 driven_on = last_move(first);
    const Recording all = carried_off(std::move(first), second, driven_on);
    Localizer localizer(scene_.map, settings(), index_);
    localizer.start(all.first_guess.pose, all.first_guess.covariance);
    return follow(localizer, all, parted, options_.trace == static_cast<int>(run) + 1);
  }

  Outcome anywhere(std::size_t run) const {
    const Recording all = record(way_from(run % scene_.cases.size()), options_.seed + run);
    Localizer localizer(scene_.map, settings(), index_);
    localizer.start_anywhere();
    return follow(localizer, all, 0, options_.trace == static_cast<int>(run) + 1);
  }

 private:
  std::vector<Pose2> way_from(std::size_t place) const {
    if (!scene_.drives.empty()) return scene_.drives[place];
    return roam(caster_, *scene_.cases[place].truth, kAfter);
  }

  /// Whether so much of what is in sight differs from the mine without its mark; everywhere where
  /// no mark is told.
  bool sees_mark(const Pose2& vehicle) const {
    constexpr int kEvery = 4;       // beams
    constexpr double kOther = 0.5;  // m
    constexpr double kShare = 0.03;
    if (scene_.unmarked.empty()) return true;
    int beams = 0;
    int others = 0;
    for (int beam = 0; beam < spec_.beams; beam += kEvery) {
      const Vector2d along =
          unit_vector(vehicle.theta + spec_.first_bearing + beam * spec_.bearing_step);
      const double reach = spec_.model.max_range_m;
      const double with = caster_.range(vehicle.translation(), along, reach);
      const double without = unmarked_.range(vehicle.translation(), along, reach);
      ++beams;
      others += std::abs(std::min(with, reach) - std::min(without, reach)) > kOther ? 1 : 0;
    }
    return others > kShare * beams;
  }

  std::vector<Segment> segments() const {
    std::vector<Segment> walls;
    for (const Wall& wall : scene_.map.walls()) walls.push_back(wall.segment);
    return walls;
  }

  LocalizerSettings settings() const {
    LocalizerSettings settings;
    settings.scanner = scene_.scanner;
    settings.odometry = mockup_odometry();
    settings.map.sigma_m = options_.map_sigma;
    return settings;
  }

  Recording record(const std::vector<Pose2>& path, std::uint64_t seed) const {
    constexpr double kNearby = 60.0;  // farther walls are in no clutter's way (m)
    World world;
    for (const Segment& wall : world_.walls) {
      if (distance(wall, path.front().translation()) < kNearby) world.walls.push_back(wall);
    }
    world.path = path;
    add_clutter(world, clutter_of(options_.clutter), seed);
    world.walls = world_.walls;
    return record_drive(world, path, spec_, {}, seed);
  }

  Outcome follow(Localizer& localizer, const Recording& drive, std::size_t parted,
                 bool is_traced) const {
    Outcome out;
    double metres = 0.0;
    bool was_marked = false;
    for (std::size_t i = 0; i < drive.scans.size(); ++i) {
      const Estimate& e = localizer.update(drive.scans[i], drive.odometry[i]);
      if (i < parted) continue;
      const Pose2& truth = drive.truth[i].pose;
      if (i > parted)
        metres += (truth.translation() - drive.truth[i - 1].pose.translation()).norm();
      was_marked = was_marked || sees_mark(truth);
      if (!was_marked) out.metres_to_mark = metres;
      const Vector3d off = difference(truth, e.pose);
      const bool right = off.head<2>().norm() < kRight && std::abs(off.z()) < radians(5.0);
      const bool trusted = e.status == Status::ok || e.status == Status::degraded;
      ++out.scans;
      out.trusted += trusted ? 1 : 0;
      out.trusted_wrong += trusted && !right ? 1 : 0;
      if (e.status == Status::ok && right && out.metres_to_right < 0.0)
        out.metres_to_right = metres;
      if (is_traced) trace(localizer, truth, metres);
    }
    return out;
  }

  /// A scan's line: the way, the status, how far off, and the poses that are carried: how many, the
  /// weight and the error of the first, and whether the true one is among them.
  static void trace(const Localizer& localizer, const Pose2& truth, double metres) {
    const Estimate& e = localizer.estimate();
    const auto off = [&](const Pose2& pose) {
      return (pose.translation() - truth.translation()).norm();
    };
    fmt::print("{:6.1f} m  {:<9} {:6.1f} m off  evidence {:.2f}", metres, to_string(e.status),
               off(e.pose), quality_of(localizer.scan_fit()).evidence_ratio);
    const auto& carried = localizer.hypotheses().all();
    if (!carried.empty()) {
      const auto is_true = [&](const auto& h) { return off(h.tracker.estimate().pose) < kRight; };
      const auto known = std::find_if(carried.begin(), carried.end(), is_true);
      fmt::print("  {} poses, first {:.3f} and {:.1f} m off", carried.size(),
                 carried.front().weight, off(carried.front().tracker.estimate().pose));
      if (known != carried.end()) {
        fmt::print(", true one {:.2g}, explained {} scans {:.1f} m{}", known->weight,
                   known->explained, known->explained_m, known->is_own ? ", own" : "");
      }
    }
    fmt::print("\n");
  }

  const LocateScene& scene_;
  const LocateOptions& options_;
  ScannerSpec spec_;
  World world_;
  RayCaster caster_;
  RayCaster unmarked_;
  std::shared_ptr<const PlaceIndex> index_;
};

/// Way until the answer was `ok` and right, from where the mark came in sight, if there is one.
double late_by(const Outcome& outcome) {
  return std::max(0.0, outcome.metres_to_right - outcome.metres_to_mark);
}

/// Names a run that found the pose late or never, or trusted a wrong one.
void list(const char* name, std::size_t run, const Outcome& outcome) {
  const bool is_late = outcome.metres_to_right < 0.0 || late_by(outcome) > kSoon;
  if (outcome.trusted_wrong == 0 && !is_late) return;
  fmt::print("{} {}: {} trusted wrongly, right after {:.1f} m, mark in sight after {:.1f} m\n",
             name, run + 1, outcome.trusted_wrong, outcome.metres_to_right, outcome.metres_to_mark);
}

void print(const char* name, std::span<const Outcome> outcomes) {
  std::vector<double> metres;
  int never = 0;
  int wrong_runs = 0;
  int wrong = 0;
  double trusted = 0.0;
  double scans = 0.0;
  for (const Outcome& outcome : outcomes) {
    if (outcome.metres_to_right >= 0.0) metres.push_back(late_by(outcome));
    never += outcome.metres_to_right < 0.0 ? 1 : 0;
    wrong_runs += outcome.trusted_wrong > 0 ? 1 : 0;
    wrong += outcome.trusted_wrong;
    trusted += outcome.trusted;
    scans += outcome.scans;
  }
  std::sort(metres.begin(), metres.end());
  const auto within = std::upper_bound(metres.begin(), metres.end(), kSoon) - metres.begin();
  const double median = metres.empty() ? 0.0 : metres[metres.size() / 2];
  fmt::print(
      "{:<10} runs {}  ok and right within {:.0f} m: {}  never: {}  median way {:.1f} m  trusted "
      "{:.1f} % of {} scans  ok and wrong: {} scans in {} runs\n",
      name, outcomes.size(), kSoon, within, never, median, 100.0 * trusted / std::max(1.0, scans),
      scans, wrong, wrong_runs);
}

int run(const LocateOptions& options) {
  const auto scene = make_locate_scene(options);
  if (!scene) {
    fmt::print(stderr, "{}\n", to_string(scene.error()));
    return 1;
  }
  const bool has_truth = std::all_of(scene->cases.begin(), scene->cases.end(),
                                     [](const LocateCase& one) { return one.truth.has_value(); });
  if (scene->cases.size() < 2 || !has_truth) {
    fmt::print(stderr, "drives need two poses at least, in the plan that is sought in\n");
    return 1;
  }
  const Mine mine(*scene, options);
  std::vector<Outcome> kidnapped;
  std::vector<Outcome> anywhere;
  for (int i = 0; i < options.count; ++i) {
    if (options.trace > 0 && options.trace != i + 1) continue;
    const auto run = static_cast<std::size_t>(i);
    kidnapped.push_back(mine.kidnapped(run));
    if (options.worst > 0) list("kidnapped", run, kidnapped.back());
    anywhere.push_back(mine.anywhere(run));
    if (options.worst > 0) list("anywhere", run, anywhere.back());
  }
  print("kidnapped", kidnapped);
  print("anywhere", anywhere);
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
