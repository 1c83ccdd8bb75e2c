#include "scene.hpp"

#include <algorithm>
#include <cmath>

#include "adit/simulation/carried_off.hpp"
#include "adit/simulation/drive.hpp"
#include "parts.hpp"

namespace adit {
namespace {

constexpr std::uint64_t kSecondRecording = 1000000007;  // added to the seed

Recording record(const Cell& cell, const Scene& scene, const std::vector<Pose2>& poses,
                 const TimedPath& way, std::uint64_t seed) {
  return cell.task == Task::stops
             ? record_stops(scene.world, poses, scene.scanner(), scene.drive, seed)
             : record_drive(scene.world, way, scene.scanners, scene.drive, seed);
}

void record_all(const Cell& cell, std::uint64_t seed, Scene& scene) {
  scene.recording = record(cell, scene, scene.path, scene.timed_path(), seed);
  if (scene.after.empty()) return;
  scene.fault_at = scene.recording.scans.size();
  const TimedPath way =
      drive_along(scene.after, scene.drive.speed_m_per_s, scene.drive.turn_rate_rad_per_s);
  const Recording second = record(cell, scene, scene.after, way, seed + kSecondRecording);
  const Pose2 shown = last_move(scene.recording);
  scene.recording = carried_off(std::move(scene.recording), second, shown);
}

/// The first scan from the fault on that sees what tells a panel's sides apart.
std::size_t mark_in_sight(const Scene& scene) {
  constexpr int kEvery = 4;       // beams
  constexpr double kOther = 0.5;  // m
  constexpr double kShare = 0.03;
  const RayCaster bare(scene.ground->bare);
  const double reach = scene.scanner().model.max_range_m;
  for (std::size_t i = scene.fault_at; i < scene.recording.truth.size(); ++i) {
    const Pose2& vehicle = scene.recording.truth[i].pose;
    int beams = 0;
    int others = 0;
    for (int beam = 0; beam < scene.scanner().beams; beam += kEvery, ++beams) {
      const Vector2d along = unit_vector(vehicle.theta + scene.scanner().first_bearing +
                                         beam * scene.scanner().bearing_step);
      const auto seen = [&](const RayCaster& walls) {
        return std::min(reach, walls.range(vehicle.translation(), along, reach));
      };
      others += std::abs(seen(scene.ground->caster) - seen(bare)) > kOther ? 1 : 0;
    }
    if (others > kShare * beams) return i;
  }
  return scene.recording.truth.size() - 1;
}

/// Where the machine enters what the plan lacks, and where it first is out of it again.
void find_missing_part(Scene& scene) {
  const auto& truth = scene.recording.truth;
  const auto is_inside = [&](const StampedPose& pose) {
    return (pose.pose.translation() - *scene.missing).norm() < kOffPlanRadius;
  };
  const auto in = std::find_if(truth.begin(), truth.end(), is_inside);
  const auto out = std::find_if_not(in, truth.end(), is_inside);
  scene.fault_at = static_cast<std::size_t>(in - truth.begin());
  scene.news_at = static_cast<std::size_t>(out - truth.begin());
}

}  // namespace

LocalizerSettings settings_of(const Cell& cell) {
  LocalizerSettings settings;
  if (const auto scanner = scanner_named(cell.scanner)) settings.scanner = scanner->model;
  if (cell.fault == ScannerFault::one_of_two) settings.more_scanners = {settings.scanner};
  settings.odometry = noise_of(cell.wheels);
  settings.map.is_stated = true;
  settings.map.sigma_m = cell.stated_m;
  return settings;
}

TimedPath Scene::timed_path() const {
  if (least_s.empty()) {
    return drive_along(path, drive.speed_m_per_s, drive.turn_rate_rad_per_s);
  }
  return timed({path, least_s}, drive.speed_m_per_s, drive.turn_rate_rad_per_s);
}

Result<Scene> make_scene(const Cell& cell, Grounds& grounds, std::uint64_t base_seed,
                         std::int64_t drive) {
  const std::uint64_t seed = seed_of(cell, base_seed, drive);
  const auto ground = grounds.of(cell.mine, drive);
  if (!ground) return tl::unexpected(ground.error());
  Scene scene;
  scene.ground = *ground;
  scene.world = (*ground)->world;
  scene.drive.odometry = noise_of(cell.wheels);
  scene.settings = settings_of(cell);
  if (!choose_way(cell, seed, drive, scene)) return fail("there is no way to drive");
  if (!apply_plan_error(cell, seed, scene)) return fail("the plan's error finds no place");
  add_things(cell, seed, scene);
  const double drive_s = scene.timed_path().end();
  scene.drive.faults = wheel_faults(cell.wheels, drive_s, seed);
  scene.scanners = faulty_scanners(cell, drive_s);
  record_all(cell, seed, scene);
  if (!choose_start(cell, seed, scene)) return fail("there is no wrong start");
  if (scene.missing) find_missing_part(scene);
  if (!scene.ground->bare.empty()) scene.news_at = mark_in_sight(scene);
  return scene;
}

}  // namespace adit
