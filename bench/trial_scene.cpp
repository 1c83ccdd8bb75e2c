#include "trial_scene.hpp"

#include "adit/simulation/clutter.hpp"
#include "adit/simulation/mine_worlds.hpp"

namespace adit {
namespace {

constexpr std::uint64_t kStraightWalls = 21;  // stream of the seed

/// The roughness that docs/benchmarks.md states for panel and drift: RMS 0.15 m, corner radius 0.7
/// m.
DriftOptions evenly_rough_drift() {
  DriftOptions options;
  options.walls = {};
  return options;
}

/// A drift without end as far as the scanner can tell: from its middle third no preset scanner
/// reaches either end, so that nothing but odometry tells the place along it.
World straight_drift(std::uint64_t seed) {
  constexpr double kLength = 300.0;
  constexpr double kWidth = 5.0;
  constexpr double kStep = 1.6;
  Random random(seed, kStraightWalls);
  const std::vector<Vector2d> corners{{0.0, 0.0}, {kLength, 0.0}, {kLength, kWidth}, {0.0, kWidth}};
  World world;
  world.plan = outline(corners);
  world.walls = outline(roughen({corners, true}, RoughnessOptions{}, random).points);
  const std::vector<Vector2d> way{{kLength / 3.0, 0.5 * kWidth},
                                  {2.0 * kLength / 3.0, 0.5 * kWidth}};
  world.path = drive_through(way, 0.0, kStep);
  return world;
}

/// Where the entries of a panel cross its crosscuts.
std::vector<Vector2d> crossings(const PanelOptions& o) {
  std::vector<Vector2d> middles;
  for (int row = 0; row <= o.rows; ++row) {
    for (int column = 0; column <= o.columns; ++column) {
      middles.emplace_back(0.5 * o.entry_width_m + column * (o.pillar_length_m + o.entry_width_m),
                           0.5 * o.entry_width_m + row * (o.pillar_width_m + o.entry_width_m));
    }
  }
  return middles;
}

/// The mouths of a drift's side cuts: in the plan's outline three sides of known lengths.
std::vector<Vector2d> side_cuts(const std::vector<Segment>& plan, const DriftOptions& o) {
  const auto is = [](const Segment& s, double length) {
    return std::abs(s.length() - length) < 1e-6;
  };
  std::vector<Vector2d> mouths;
  for (std::size_t i = 0; i + 2 < plan.size(); ++i) {
    const bool cut = is(plan[i], o.side_cut_depth_m) && is(plan[i + 1], o.side_cut_width_m) &&
                     is(plan[i + 2], o.side_cut_depth_m);
    if (cut) mouths.emplace_back(0.5 * (plan[i].a + plan[i + 2].b));
  }
  return mouths;
}

void lay_world(TrialWorld kind, std::uint64_t seed, TrialScene& scene) {
  switch (kind) {
    case TrialWorld::panel:
    case TrialWorld::sweep_panel:
      scene.world = panel({}, seed);
      scene.intersections = crossings({});
      return;
    case TrialWorld::drift:
    case TrialWorld::drift_rough: {
      const DriftOptions options =
          kind == TrialWorld::drift ? evenly_rough_drift() : DriftOptions{};
      scene.world = drift(options, seed);
      scene.intersections = side_cuts(scene.world.plan, options);
      return;
    }
    case TrialWorld::straight:
      scene.world = straight_drift(seed);
      return;
    case TrialWorld::mockup:
    case TrialWorld::sweep:
    case TrialWorld::stress:
      scene.world = mockup();
      return;
  }
}

/// The stress of the mark to beat: a bad first guess, bad odometry, 25 boxes about.
void stress(std::uint64_t seed, TrialScene& scene) {
  ClutterOptions boxes;
  boxes.boxes = 25;
  boxes.people = 0;
  scene.clutter = add_clutter(scene.world, boxes, seed);
  scene.drive.odometry.translation_sigma_ratio = 0.15;
  scene.drive.odometry.rotation_sigma_rad_per_m = radians(6.0) / 1.6;  // 6 degrees a step
  scene.drive.first_guess_sigma_m = 0.5;
  scene.drive.first_guess_sigma_rad = radians(6.0);
}

}  // namespace

TrialScene make_scene(const TrialOptions& options, std::uint64_t seed) {
  TrialScene scene;
  lay_world(options.world, seed, scene);
  if (options.world == TrialWorld::stress) {
    stress(seed, scene);
  } else {
    scene.clutter = add_clutter(scene.world, clutter_of(options.clutter), seed);
  }
  scene.scanner = *scanner_named(options.scanner);
  scene.stops = options.stops();
  if (!scene.stops) scene.drive.speed_m_per_s = options.speed.value_or(1.0);
  scene.settings.estimator = options.estimator;
  scene.settings.scanner = scene.scanner.model;
  scene.settings.odometry = scene.drive.odometry;
  scene.settings.map.is_stated = options.map_sigma != "unknown";
  if (options.map_sigma != "unknown") {
    state_map_sigma(options.stated_map_sigma().value_or(plan_error(scene.world)), scene.settings);
  }
  return scene;
}

void state_map_sigma(double sigma_m, LocalizerSettings& settings) {
  settings.map.sigma_m = sigma_m;
}

Recording record(const TrialScene& scene, std::span<const Pose2> path, std::uint64_t seed) {
  return scene.stops ? record_stops(scene.world, path, scene.scanner, scene.drive, seed)
                     : record_drive(scene.world, path, scene.scanner, scene.drive, seed);
}

}  // namespace adit
