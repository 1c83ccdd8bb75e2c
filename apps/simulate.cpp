#include <fmt/core.h>

#include "adit/config/configuration.hpp"
#include "adit/io/carmen.hpp"
#include "adit/io/plan.hpp"
#include "adit/io/trajectory.hpp"
<<<<<<< HEAD
#include "adit/simulation/machine_ahead.hpp"
=======
#include "adit/simulation/clutter.hpp"
#include "adit/simulation/drive.hpp"
>>>>>>> drives
#include "adit/simulation/mine_worlds.hpp"
#include "adit/simulation/vehicle.hpp"
#include "commands.hpp"
#include "output_folder.hpp"
#include "recording_log.hpp"
#include "report_error.hpp"
<<<<<<< HEAD
#include "world_changes.hpp"
=======
#include "simulate_faults.hpp"
>>>>>>> drives

namespace adit {
namespace {

constexpr double kMostScans = 1e6;

struct Scene {
  World world;
  ScannerSpec scanner;
  DriveOptions drive;
  bool stops = false;
<<<<<<< HEAD
  double plan_sigma_m = 0.0;
=======
  std::vector<double> least_s;  ///< as in Drive
>>>>>>> drives
};

Result<World> world_named(const SimulateArguments& arguments) {
  World world;
  if (arguments.world == "mockup") {
    world = mockup();
    world.path = mockup_path();
  } else if (arguments.world == "panel") {
    world = panel({}, arguments.seed);
  } else if (arguments.world == "drift") {
    world = drift({}, arguments.seed);
  } else {
    Result<Plan> plan = read_plan(arguments.world);
    if (!plan) return tl::unexpected(plan.error());
    world = from_plan(std::move(plan->segments));
  }
  if (!arguments.path.empty()) {
    const auto path = read_trajectory(arguments.path);
    if (!path) return tl::unexpected(path.error());
    world.path.clear();
    for (const StampedPose& pose : *path) world.path.push_back(pose.pose);
  }
  return world;
}

/// Gives a scene without a path, or whose path is not wanted, a drive at random.
Result<void> plan_drive(const SimulateArguments& arguments, Scene& scene) {
  constexpr double kLength = 120.0;  // m
  if (!arguments.drive && !scene.world.path.empty()) return {};
  RandomDriveOptions options;
  options.length_m = arguments.drive.value_or(kLength);
  options.stops = arguments.stops;
  options.turns = arguments.turns;
  options.creeps = arguments.creeps;
  Drive drive = random_drive(DriveMap(scene.world.walls), options, arguments.seed);
  if (drive.poses.empty()) return fail("no opening is wide enough to drive in", arguments.world);
  scene.world.path = std::move(drive.poses);
  scene.least_s = std::move(drive.least_s);
  return {};
}

/// Where the vehicle is at what time, but for hops.
TimedPath drive_of(const Scene& scene) {
  return timed({scene.world.path, scene.least_s}, scene.drive.speed_m_per_s,
               scene.drive.turn_rate_rad_per_s);
}

/// The preset, then the configuration file over it, then the command line over both.
Result<Scene> make_scene(const SimulateArguments& arguments) {
  Scene scene;
  const std::optional<ScannerSpec> preset = scanner_named(arguments.scanner);
  if (!preset)
    return fail("no scanner '" + arguments.scanner + "': cyclone, sick, sick_lms, hokuyo");
  scene.scanner = *preset;
  Configuration base;
  base.localizer.scanner = scene.scanner.model;
  base.localizer.odometry = scene.drive.odometry;
  if (!arguments.config.empty()) {
    const auto loaded = read_configuration(arguments.config, base);
    if (!loaded) return tl::unexpected(loaded.error());
    base = loaded->values;
  }
  scene.scanner.model = base.localizer.scanner;
  scene.drive.odometry = base.localizer.odometry;
  if (arguments.sweep) scene.scanner.model.sweep_s = *arguments.sweep;
  if (!arguments.odometry.empty()) {
    scene.drive.odometry.translation_sigma_ratio = arguments.odometry[0];
    scene.drive.odometry.rotation_sigma_rad_per_m = radians(arguments.odometry[1]);
    scene.drive.odometry.rotation_sigma_ratio = arguments.odometry[2];
  }
  const auto set = set_faults(arguments.faults, scene.drive.faults, scene.scanner.faults);
  if (!set) return tl::unexpected(set.error());
  const double speed = arguments.speed.value_or(arguments.world == "mockup" ? 0.0 : 1.0);
  scene.stops = speed == 0.0;
  if (!scene.stops) scene.drive.speed_m_per_s = speed;
  auto world = world_named(arguments);
  if (!world) return tl::unexpected(world.error());
  scene.world = std::move(*world);
<<<<<<< HEAD
  const auto sigma = change_world(arguments, scene.world);
  if (!sigma) return tl::unexpected(sigma.error());
  scene.plan_sigma_m = *sigma;
  if (const auto done = furnish(arguments, scene.world); !done) return tl::unexpected(done.error());
=======
  if (const auto planned = plan_drive(arguments, scene); !planned)
    return tl::unexpected(planned.error());
>>>>>>> drives
  return scene;
}

/// Where the vehicle is at what time, but for hops.
TimedPath drive_of(const Scene& scene) {
  const DriveOptions& drive = scene.drive;
  if (!scene.stops) {
    return drive_along(scene.world.path, drive.speed_m_per_s, drive.turn_rate_rad_per_s);
  }
  TimedPath stops;
  for (const Pose2& pose : scene.world.path) {
    const auto before = static_cast<double>(stops.knots.size());
    stops.knots.push_back({before * drive.stop_interval_s, pose});
  }
  return stops;
}

/// An Error where the drive would bring home more scans than a computer holds.
Result<void> check_size(const Scene& scene) {
  const DriveOptions& drive = scene.drive;
  const double scans = scene.stops ? static_cast<double>(scene.world.path.size())
                                   : drive_of(scene).end() * drive.scan_rate_hz;
  if (scans <= kMostScans) return {};
  return fail(fmt::format("the path and the speed make {:.3g} scans; at most {:.0f} are simulated",
                          scans, kMostScans));
}

Result<void> write_scene(const std::string& folder, const Scene& scene,
                         const Recording& recording) {
  Configuration configuration;
  configuration.localizer.scanner = scene.scanner.model;
  configuration.localizer.odometry = scene.drive.odometry;
  configuration.localizer.map.sigma_m = scene.plan_sigma_m;
  using Path = const std::string&;
  return write_all(
      folder,
      {{"plan.csv", [&](Path path) { return write_plan(scene.world.plan, path); }},
       {"mine.csv", [&](Path path) { return write_plan(scene.world.walls, path); }},
       {"log.clf", [&](Path path) { return write_carmen(to_log(recording, scene.scanner), path); }},
       {"truth.tum", [&](Path path) { return write_trajectory(recording.truth, path); }},
       {"config.toml", [&](Path path) {
          return write_configuration(configuration, path, {"scanner", "odometry", "map.sigma_m"});
        }}});
}

}  // namespace

int run_simulate(const SimulateArguments& arguments) {
  auto scene = make_scene(arguments);
  if (!scene) return report(scene.error(), scene.error().file.empty() ? kWrongCall : kFailed);
  if (const auto fits = check_size(*scene); !fits) return report(fits.error());
<<<<<<< HEAD
  if (arguments.machine_ahead) {
    add_machine_ahead(scene->world, drive_of(*scene), {.gap_m = *arguments.machine_ahead});
  }
  const Recording recording = scene->stops
                                  ? record_stops(scene->world, scene->world.path, scene->scanner,
                                                 scene->drive, arguments.seed)
                                  : record_drive(scene->world, scene->world.path, scene->scanner,
                                                 scene->drive, arguments.seed);
=======
  const int pieces = add_clutter(scene->world, clutter_of(arguments.clutter), arguments.seed);
  const Recording recording =
      scene->stops ? record_stops(scene->world, scene->world.path, scene->scanner, scene->drive,
                                  arguments.seed)
                   : record_drive(scene->world, drive_of(*scene), {&scene->scanner, 1},
                                  scene->drive, arguments.seed);
>>>>>>> drives
  if (const auto written = write_scene(arguments.output, *scene, recording); !written) {
    return report(written.error());
  }
  fmt::print("{} scans; wrote plan.csv, mine.csv, log.clf, truth.tum, config.toml to {}\n",
             recording.scans.size(), arguments.output);
  return kDone;
}

}  // namespace adit
