#include "trial_sweep.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <vector>

#include "adit/evaluation/statistics.hpp"
#include "adit/simulation/wall_shape.hpp"
#include "trial_consistency.hpp"
#include "trial_figures.hpp"
#include "trial_run.hpp"

namespace adit {
namespace {

constexpr double kSpeed = 5.0;  // m/s
constexpr double kSweep = 0.2;  // s
constexpr double kTurnRate = radians(45.0);

/// Round the mockup's pillar, or stairs through the panel, in the middle of the openings; every
/// second seed the other way round.
std::vector<Pose2> fast_path(TrialWorld world, std::uint64_t seed) {
  constexpr double kStep = 0.25;  // m
  std::vector<Vector2d> way{{3.5, 22.0},  {3.5, 3.3},  {17.0, 3.3},
                            {17.0, 19.4}, {3.5, 14.4}, {3.5, 4.5}};
  if (world == TrialWorld::sweep_panel) {
    way = {{3.0, 3.0},   {23.0, 3.0},  {23.0, 23.0}, {43.0, 23.0},
           {43.0, 43.0}, {63.0, 43.0}, {63.0, 63.0}, {83.0, 63.0}};
  }
  if (seed % 2 == 0) std::reverse(way.begin(), way.end());
  // A bend in which the speed makes the turn rate, where there is room for it.
  return drive_through(way, kSpeed / kTurnRate, kStep);
}

TrialScene fast_scene(const TrialOptions& options, std::uint64_t seed) {
  TrialScene scene = make_scene(options, seed);
  scene.world.path = fast_path(options.world, seed);
  scene.drive.speed_m_per_s = kSpeed;
  // A little more, so that the corners of the path's many pieces do not slow the drive.
  scene.drive.turn_rate_rad_per_s = 1.05 * kTurnRate;
  scene.drive.scan_rate_hz = 1.0 / kSweep;
  scene.drive.odometry_rate_hz = 50.0;
  // Stamped in the middle, a sweep begins half its time before.
  scene.drive.odometry_error_lead = options.errors == ErrorSpan::sweeps ? 0.5 : 0.0;
  scene.drive.odometry.translation_sigma_ratio = 0.02;
  scene.drive.odometry.rotation_sigma_rad_per_m = radians(0.2) / (kSpeed * kSweep);
  scene.settings.odometry = scene.drive.odometry;
  return scene;
}

TrialRun moving_run(TrialScene scene, std::uint64_t seed) {
  scene.scanner.model.sweep_s = kSweep;
  scene.scanner.model.stamp = SweepMoment::middle;
  scene.settings.scanner = scene.scanner.model;
  scene.stops = false;
  TrialRun run = plain_run(std::move(scene), seed);
  run.feeds_wheels = true;
  return run;
}

/// The same poses, a stop at each.
TrialRun standing_run(TrialScene scene, const TrialRun& moving, std::uint64_t seed) {
  scene.world.path.clear();
  for (const StampedPose& truth : moving.recording.truth) scene.world.path.push_back(truth.pose);
  scene.stops = true;
  return plain_run(std::move(scene), seed);
}

/// Whether the vehicle turns by a good part of the rate at each answer.
std::vector<bool> in_bends(const std::vector<Answer>& answers) {
  std::vector<bool> bends(answers.size(), false);
  for (std::size_t i = 1; i < answers.size(); ++i) {
    const double turn = std::abs(angle_between(answers[i - 1].truth.theta, answers[i].truth.theta));
    bends[i] = answers[i].seed == answers[i - 1].seed && turn > 0.5 * kTurnRate * kSweep;
  }
  return bends;
}

struct MeanErrors {
  double position_m = 0.0;
  double heading_deg = 0.0;
  std::int64_t count = 0;
};

MeanErrors mean_errors(const std::vector<Answer>& answers, const std::vector<bool>& counts) {
  std::vector<double> position, heading;
  for (std::size_t i = 0; i < answers.size(); ++i) {
    if (!counts[i]) continue;
    position.push_back(answers[i].position_error());
    heading.push_back(degrees(answers[i].heading_error()));
  }
  const Statistics metres = summarise(position);
  return {metres.mean, summarise(heading).mean, metres.count};
}

std::string ratio_row(const char* name, const MeanErrors& moving, const MeanErrors& standing) {
  return fmt::format(
      "{:<10} position {:.4f} m moving, {:.4f} standing: {:.3f}   heading {:.4f} deg, {:.4f}: "
      "{:.3f}   "
      "({})\n",
      name, moving.position_m, standing.position_m, moving.position_m / standing.position_m,
      moving.heading_deg, standing.heading_deg, moving.heading_deg / standing.heading_deg,
      moving.count);
}

}  // namespace

std::string sweep_trial(const TrialOptions& options) {
  std::vector<Answer> moving, standing;
  for (int k = 0; k < options.runs; ++k) {
    const std::uint64_t seed = options.seed + static_cast<std::uint64_t>(k);
    const TrialScene scene = fast_scene(options, seed);
    const TrialRun run = moving_run(scene, seed);
    localise(run, options, seed, moving);
    localise(standing_run(scene, run, seed), options, seed, standing);
  }
  const std::vector<bool> all(moving.size(), true);
  const std::vector<bool> bends = in_bends(moving);
  return ratio_row("all", mean_errors(moving, all), mean_errors(standing, all)) +
         ratio_row("in bends", mean_errors(moving, bends), mean_errors(standing, bends)) +
         "moving:\n" + accuracy_text(moving) + status_text(moving) + consistency_text(moving) +
         time_text(moving) + "standing:\n" + accuracy_text(standing);
}

}  // namespace adit
