// The paper's experiment, many times over: the 16-pose run through the mockup with the Cyclone and
// clutter, localised with features alone. Prints the figures of docs/benchmarks.md.
//
//   mockup_trials [runs = 500] [first seed = 1] [pieces of clutter = 8]

#include <fmt/core.h>

#include <algorithm>
#include <cstdlib>
#include <vector>

#include "adit/evaluation/report.hpp"
#include "adit/localizer/localizer.hpp"
#include "adit/simulation/clutter.hpp"
#include "adit/simulation/vehicle.hpp"

namespace adit {
namespace {

struct Trial {
  std::vector<EstimateSample> estimates;
  std::vector<StampedPose> truth;
  bool lost = false;
};

struct Times {
  std::vector<double> prediction, extraction, matching, estimation, total;
  void add(const Timings& t) {
    prediction.push_back(t.prediction);
    extraction.push_back(t.extraction);
    matching.push_back(t.matching);
    estimation.push_back(t.estimation);
    total.push_back(t.total());
  }
};

double quantile_us(std::vector<double> seconds, double q) {
  const auto place =
      seconds.begin() + static_cast<std::ptrdiff_t>(q * static_cast<double>(seconds.size() - 1));
  std::nth_element(seconds.begin(), place, seconds.end());
  return 1e6 * *place;
}

LocalizerSettings settings_for(const ScannerSpec& spec, const DriveOptions& drive) {
  LocalizerSettings settings;
  settings.scanner = spec.model;
  settings.odometry = drive.odometry;
  settings.estimation.map_sigma_m = 0.0;  // the mockup's plan is exact
  return settings;
}

Trial run(const LineMap& map, std::uint64_t seed, int clutter, Times& times,
          std::vector<double>& calls) {
  World world = mockup();
  world.path = mockup_path();
  add_clutter(world, clutter_of(clutter), seed);
  const DriveOptions drive;
  const ScannerSpec spec = cyclone();
  const Recording recording = record_stops(world, world.path, spec, drive, seed);

  Localizer localizer(map, settings_for(spec, drive));
  localizer.start(recording.first_guess.pose, recording.first_guess.covariance);
  Trial trial;
  trial.truth = recording.truth;
  for (std::size_t i = 0; i < recording.scans.size(); ++i) {
    const Estimate& e = localizer.update(recording.scans[i], recording.odometry[i]);
    trial.estimates.push_back({e.stamp, e.pose, e.covariance, e.status, e.protection_m});
    times.add(localizer.timings());
    calls.push_back(localizer.match().calls);
    if (std::getenv("ADIT_TRIALS_VERBOSE") != nullptr) {
      const Vector2d error = e.pose.translation() - recording.truth[i].pose.translation();
      fmt::print("{} {:2} {} error {:.3f} sigma {:.3f} pairs {} of {} dropped {} chi2 {:.1f}/{}\n",
                 seed, i, to_string(e.status), error.norm(),
                 std::sqrt(e.covariance.topLeftCorner<2, 2>().trace()), e.pairs.size(),
                 localizer.match().candidates, localizer.fit().dropped, e.chi_square,
                 e.degrees_of_freedom);
    }
  }
  return trial;
}

int trials(int runs, std::uint64_t first_seed, int clutter) {
  const LineMap map = LineMap::build(mockup().plan);
  Times times;
  std::vector<double> calls;
  std::vector<EstimateSample> estimates;
  std::vector<StampedPose> truth;
  int lost = 0;
  for (int k = 0; k < runs; ++k) {
    Trial trial = run(map, first_seed + static_cast<std::uint64_t>(k), clutter, times, calls);
    const EvaluationReport report =
        evaluate({.estimates = trial.estimates, .truth = trial.truth, .relations = {}});
    lost += report.beyond_lost > 0 ? 1 : 0;
    const double offset = 1e4 * k;  // stamps of the runs must not join
    for (EstimateSample& e : trial.estimates) {
      e.stamp += offset;
      estimates.push_back(e);
    }
    for (StampedPose& t : trial.truth) truth.push_back({t.stamp + offset, t.pose});
  }
  const EvaluationReport all = evaluate({.estimates = estimates, .truth = truth, .relations = {}});
  fmt::print("{} runs from seed {}, {} pieces of clutter\n{}", runs, first_seed, clutter,
             to_text(all));
  fmt::print("lost runs {}\n", lost);
  fmt::print("calls of the search: median {:.0f}, largest {:.0f}\n", 1e-6 * quantile_us(calls, 0.5),
             1e-6 * quantile_us(calls, 1.0));
  fmt::print(
      "microseconds (median, p99): prediction {:.1f} {:.1f}, extraction {:.1f} {:.1f}, "
      "matching {:.1f} {:.1f}, estimation {:.1f} {:.1f}, cycle {:.1f} {:.1f}\n",
      quantile_us(times.prediction, 0.5), quantile_us(times.prediction, 0.99),
      quantile_us(times.extraction, 0.5), quantile_us(times.extraction, 0.99),
      quantile_us(times.matching, 0.5), quantile_us(times.matching, 0.99),
      quantile_us(times.estimation, 0.5), quantile_us(times.estimation, 0.99),
      quantile_us(times.total, 0.5), quantile_us(times.total, 0.99));
  return 0;
}

}  // namespace
}  // namespace adit

int main(int argc, char** argv) {
  const auto argument = [&](int i, int otherwise) {
    return argc > i ? std::atoi(argv[i]) : otherwise;
  };
  return adit::trials(argument(1, 500), static_cast<std::uint64_t>(argument(2, 1)), argument(3, 8));
}
