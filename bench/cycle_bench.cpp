// Estimation alone and the whole cycle, on the paper's run.
#include <benchmark/benchmark.h>

#include "mockup_run.hpp"

namespace adit {
namespace {

void estimate_pose(benchmark::State& state) {
  const MockupRun run(12);
  const LineMap map = LineMap::build(run.world.plan);
  Localizer localizer(map, run.settings);
  localizer.start(run.recording.first_guess.pose, run.recording.first_guess.covariance);
  localizer.update(run.recording.scans[0], run.recording.odometry[0]);
  const Pose2 start{0.0, 0.0, localizer.predicted().pose.theta};
  FeatureEstimator estimator;
  const auto fit = [&] {
    return estimator.fit(localizer.sensed_features(), localizer.model_features(),
                         localizer.match().pairs, start, run.settings.estimation);
  };
  const Vector2d position = localizer.predicted().pose.translation() + fit().pose.translation();
  if ((position - run.recording.truth[0].pose.translation()).norm() > 0.05) {
    state.SkipWithError("the estimate is off by more than 5 cm");
    return;
  }
  for (auto _ : state) benchmark::DoNotOptimize(fit().chi_square);
}
BENCHMARK(estimate_pose)->Unit(benchmark::kMicrosecond);

void whole_cycle(benchmark::State& state) {
  const MockupRun run(13);
  const LineMap map = LineMap::build(run.world.plan);
  Localizer localizer(map, run.settings);
  std::size_t i = 0;
  const auto turn = [&] {
    if (i % run.recording.scans.size() == 0) {
      localizer.start(run.recording.first_guess.pose, run.recording.first_guess.covariance);
    }
    const std::size_t k = i++ % run.recording.scans.size();
    return localizer.update(run.recording.scans[k], run.recording.odometry[k]).pose;
  };
  for (const StampedPose& truth : run.recording.truth) {
    if ((turn().translation() - truth.pose.translation()).norm() > 0.1) {
      state.SkipWithError("an estimate is off by more than 10 cm");
      return;
    }
  }
  for (auto _ : state) benchmark::DoNotOptimize(turn().x);
}
BENCHMARK(whole_cycle)->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace adit
