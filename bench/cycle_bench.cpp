// Estimation alone and the whole cycle, on the paper's run.
#include <benchmark/benchmark.h>

#include <algorithm>

#include "adit/simulation/mine_worlds.hpp"
#include "support/mockup_run.hpp"

namespace adit {
namespace {

void estimate_pose(benchmark::State& state) {
  const Recording recording = test::record_mockup(12, 8);
  LocalizerSettings settings = test::mockup_settings();
  settings.localizer.features_every_scan = true;  // the start alone would do without
  const LineMap map = LineMap::build(mockup().plan);
  Localizer localizer(map, settings);
  localizer.start(recording.first_guess.pose, recording.first_guess.covariance);
  localizer.update(recording.scans[0], recording.odometry[0]);
  const Pose2 start{0.0, 0.0, localizer.last_turn().predicted.pose.theta};
  FeatureEstimator estimator;
  const auto fit = [&] {
    return estimator.fit(localizer.last_turn().sensed_features,
                         localizer.last_turn().model_features, localizer.last_turn().match.pairs,
                         start, settings.estimation);
  };
  const Vector2d position =
      localizer.last_turn().predicted.pose.translation() + fit().pose.translation();
  if ((position - recording.truth[0].pose.translation()).norm() > 0.05) {
    state.SkipWithError("the estimate is off by more than 5 cm");
    return;
  }
  for (auto _ : state) benchmark::DoNotOptimize(fit().chi_square);
}
BENCHMARK(estimate_pose)->Unit(benchmark::kMicrosecond);

void whole_cycle(benchmark::State& state) {
  const Recording recording = test::record_mockup(13, 8);
  const LocalizerSettings settings = test::mockup_settings();
  const LineMap map = LineMap::build(mockup().plan);
  Localizer localizer(map, settings);
  std::size_t i = 0;
  const auto turn = [&] {
    if (i % recording.scans.size() == 0) {
      localizer.start(recording.first_guess.pose, recording.first_guess.covariance);
    }
    const std::size_t k = i++ % recording.scans.size();
    return localizer.update(recording.scans[k], recording.odometry[k]).pose;
  };
  for (const StampedPose& truth : recording.truth) {
    if ((turn().translation() - truth.pose.translation()).norm() > 0.1) {
      state.SkipWithError("an estimate is off by more than 10 cm");
      return;
    }
  }
  for (auto _ : state) benchmark::DoNotOptimize(turn().x);
}
BENCHMARK(whole_cycle)->Unit(benchmark::kMicrosecond);

/// A scanner like the Cyclone with so many beams around.
ScannerSpec cyclone_of(int beams) {
  ScannerSpec spec = cyclone();
  spec.beams = beams;
  spec.bearing_step = kTwoPi / beams;
  return spec;
}

/// Turns of the cycle along a drive that is repeated, over a plan.
void drive_on(benchmark::State& state, const World& world, const ScannerSpec& spec) {
  const LineMap map = LineMap::build(world.plan);
  const DriveOptions drive;
  const Recording recording = record_stops(world, world.path, spec, drive, 17);
  LocalizerSettings settings;
  settings.scanner = spec.model;
  settings.odometry = drive.odometry;
  settings.map.sigma_m = 0.0;
  Localizer localizer(map, settings);
  std::size_t i = 0;
  std::size_t in_sight = 0;
  for (auto _ : state) {
    const std::size_t k = i++ % recording.scans.size();
    if (k == 0) localizer.start(recording.first_guess.pose, recording.first_guess.covariance);
    benchmark::DoNotOptimize(localizer.update(recording.scans[k], recording.odometry[k]).pose.x);
    in_sight += localizer.last_turn().walls.size();
  }
  state.counters["segments_in_sight"] =
      static_cast<double>(in_sight) / static_cast<double>(state.iterations());
}

void cycle_by_beams(benchmark::State& state) {
  World world = mockup();
  world.path = mockup_path();
  drive_on(state, world, cyclone_of(static_cast<int>(state.range(0))));
}
BENCHMARK(cycle_by_beams)
    ->Arg(90)
    ->Arg(180)
    ->Arg(360)
    ->Arg(500)
    ->Arg(1000)
    ->Arg(2000)
    ->Arg(4000)
    ->Unit(benchmark::kMicrosecond);

/// A panel whose plan follows its rough walls in pieces of so many centimetres.
void cycle_by_segments(benchmark::State& state) {
  PanelOptions options;
  options.rows = 2;
  options.columns = 2;
  options.walls.point_spacing_m = 0.01 * static_cast<double>(state.range(0));
  World world = panel(options, 5);
  world.plan = world.walls;
  world.path.resize(std::min<std::size_t>(world.path.size(), 40));
  drive_on(state, world, cyclone_of(1000));
}
BENCHMARK(cycle_by_segments)
    ->Arg(800)
    ->Arg(400)
    ->Arg(200)
    ->Arg(100)
    ->Arg(50)
    ->Arg(25)
    ->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace adit
