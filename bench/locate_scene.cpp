#include "locate_scene.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "adit/io/carmen.hpp"
#include "adit/io/plan.hpp"
#include "adit/io/trajectory.hpp"
#include "adit/simulation/clutter.hpp"
#include "adit/simulation/random.hpp"
#include "panel_scene.hpp"

namespace adit {
namespace {

// Streams of the seed.
constexpr std::uint64_t kNoise = 41;
constexpr std::uint64_t kPlaces = 42;
constexpr std::uint64_t kEnds = 43;

constexpr double kNearby = 25.0;  // farther walls are not in the way of clutter (m)

/// Takes scans in a mine, each with clutter of its own.
class Surveyor {
 public:
  Surveyor(std::vector<Segment> walls, const ScannerSpec& spec, const LocateOptions& options)
      : walls_(std::move(walls)), caster_(walls_), spec_(spec), options_(options) {}

  LaserScan scan_at(const Pose2& pose, std::size_t number) const {
    World world;
    world.path = {pose};
    for (const Segment& wall : walls_) {
      if (distance(wall, pose.translation()) < kNearby) world.walls.push_back(wall);
    }
    const std::uint64_t seed = options_.seed * 1000003u + number;
    add_clutter(world, clutter_of(options_.clutter), seed);
    Random noise(seed, kNoise);
    return simulate_scan(caster_, pose, spec_, noise, world.clutter);
  }

 private:
  std::vector<Segment> walls_;
  RayCaster caster_;
  ScannerSpec spec_;
  const LocateOptions& options_;
};

/// The walls of a mine whose plan has their ends elsewhere; those that met still do.
std::vector<Segment> with_moved_ends(std::vector<Segment> walls, const LocateOptions& options) {
  std::map<std::pair<double, double>, Vector2d> moved;
  Random random(options.seed, kEnds);
  for (Segment& wall : walls) {
    for (Vector2d* end : {&wall.a, &wall.b}) {
      const auto [known, is_new] = moved.try_emplace({end->x(), end->y()});
      if (is_new) {
        known->second = *end + options.rough * Vector2d(random.normal(), random.normal());
      }
      *end = known->second;
    }
  }
  return walls;
}

std::string mine(const LocateOptions& options, const std::string& name) {
  return options.data + "/mines/" + name;
}

Result<std::vector<Pose2>> poses_of(const LocateOptions& options, const std::string& plan) {
  const auto read = read_trajectory(mine(options, plan + "_poses.tum"));
  if (!read) return tl::unexpected(read.error());
  std::vector<Pose2> poses;
  const auto first = static_cast<std::size_t>(options.first);
  const std::size_t end = std::min(read->size(), first + static_cast<std::size_t>(options.count));
  for (std::size_t i = first; i < end; ++i) poses.push_back((*read)[i].pose);
  return poses;
}

/// Scans of the mine `taken_in`, sought in the plan `sought_in`.
Result<LocateScene> mine_scene(const LocateOptions& options, const ScannerSpec& spec,
                               const std::string& taken_in, const std::string& sought_in) {
  const auto walls = read_plan(mine(options, taken_in + ".csv"));
  if (!walls) return tl::unexpected(walls.error());
  const auto plan = read_plan(mine(options, sought_in + ".csv"));
  if (!plan) return tl::unexpected(plan.error());
  const auto poses = poses_of(options, taken_in);
  if (!poses) return tl::unexpected(poses.error());
  LocateScene scene;
  scene.map = LineMap::build(plan->segments);
  const Surveyor surveyor(with_moved_ends(walls->segments, options), spec, options);
  const auto first = static_cast<std::size_t>(options.first);
  for (std::size_t i = 0; i < poses->size(); ++i) {
    const Pose2& pose = (*poses)[i];
    const bool inside = taken_in == sought_in;
    scene.cases.push_back(
        {surveyor.scan_at(pose, first + i), inside ? std::optional(pose) : std::nullopt});
  }
  return scene;
}

LocateScene panel_scene(const LocateOptions& options, const ScannerSpec& spec,
                        const PanelLayout& panel) {
  const std::vector<Segment> plan = panel_walls(panel, options.seed);
  LocateScene scene;
  scene.map = LineMap::build(plan);
  const Surveyor surveyor(plan, spec, options);
  const std::vector<Pose2> places = places_in_panel(panel, options.count, options.seed);
  for (std::size_t i = 0; i < places.size(); ++i) {
    scene.cases.push_back({surveyor.scan_at(places[i], i), places[i]});
  }
  return scene;
}

/// The panel of this name, if it is one.
std::optional<PanelLayout> panel_named(const std::string& name, int side) {
  PanelLayout panel;
  panel.side = side;
  if (name == "regular") return panel;
  if (name == "big") {
    panel.variation_m = 0.5;
    return panel;
  }
  if (name == "gap") {
    panel.mark = PanelMark::missing_pillar;
    return panel;
  }
  if (name == "entry") {
    panel.mark = PanelMark::entry;
    panel.pitch_y_m = 25.0;
    return panel;
  }
  return std::nullopt;
}

/// Scans of a real log that have a reference pose, drawn at random.
Result<LocateScene> log_scene(const LocateOptions& options) {
  constexpr double kSameStamp = 1e-5;  // s: scans were stored a millisecond apart in bursts
  const auto plan = read_plan(options.data + "/intel/map.csv");
  if (!plan) return tl::unexpected(plan.error());
  const auto log = read_log(options.data + "/intel/log.clf");
  if (!log) return tl::unexpected(log.error());
  const auto reference = read_trajectory(options.data + "/intel/reference.tum");
  if (!reference) return tl::unexpected(reference.error());
  std::vector<LocateCase> known;
  for (const LogScan& entry : log->scans) {
    const auto same =
        std::find_if(reference->begin(), reference->end(), [&](const StampedPose& pose) {
          return std::abs(pose.stamp - entry.scan.stamp) < kSameStamp;
        });
    if (same != reference->end()) known.push_back({entry.scan, same->pose});
  }
  LocateScene scene;
  scene.map = LineMap::build(plan->segments);
  scene.scanner = sick_lms().model;
  scene.scanner.max_range_m = log->summary.lasers.front().max_range;
  Random random(options.seed, kPlaces);
  for (int i = 0; i < options.count && !known.empty(); ++i) {
    const auto drawn = static_cast<std::size_t>(random.below(static_cast<int>(known.size())));
    scene.cases.push_back(known[drawn]);
    known.erase(known.begin() + static_cast<std::ptrdiff_t>(drawn));
  }
  return scene;
}

Result<LocateScene> scene_of(const LocateOptions& options, const ScannerSpec& spec) {
  if (options.plan == "niosh" || options.plan == "edgar") {
    return mine_scene(options, spec, options.plan, options.plan);
  }
  if (options.plan == "outside") return mine_scene(options, spec, "edgar", "niosh");
  if (options.plan == "outside_niosh") return mine_scene(options, spec, "niosh", "edgar");
  if (const auto panel = panel_named(options.plan, options.side)) {
    return panel_scene(options, spec, *panel);
  }
  if (options.plan == "intel") return log_scene(options);
  return fail("'" + options.plan + "': no such plan");
}

}  // namespace

Result<LocateScene> make_locate_scene(const LocateOptions& options) {
  const auto spec = scanner_named(options.scanner);
  if (!spec) return fail("'" + options.scanner + "': no such scanner");
  auto scene = scene_of(options, *spec);
  if (!scene) return scene;
  if (options.plan != "intel") scene->scanner = spec->model;
  MapErrorOptions error;
  error.sigma_m = options.map_sigma;
  scene->map_error = MapErrorEstimator(error).error();
  return scene;
}

}  // namespace adit
