// The paper's experiment, many times over: the 16-pose run through the mockup with the Cyclone and
// clutter, localised with features alone. Prints the figures of docs/benchmarks.md.
//
//   mockup_trials [runs = 500] [first seed = 1] [pieces of clutter = 8]

#include <fmt/core.h>

#include <algorithm>
#include <string>
#include <vector>

#include "adit/evaluation/report.hpp"
#include "arguments.hpp"
#include "mockup_run.hpp"

namespace adit {
namespace {

struct Trial {
  std::vector<EstimateSample> estimates;
  std::vector<StampedPose> truth;
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

double quantile(std::vector<double> values, double q) {
  const auto place =
      values.begin() + static_cast<std::ptrdiff_t>(q * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), place, values.end());
  return *place;
}

/// Median and 99th percentile of seconds, in microseconds.
std::string spread(const std::vector<double>& seconds) {
  return fmt::format("{:.1f} {:.1f}", 1e6 * quantile(seconds, 0.5), 1e6 * quantile(seconds, 0.99));
}

Trial run(const LineMap& map, std::uint64_t seed, int clutter, Times& times,
          std::vector<double>& calls) {
  const MockupRun mockup_run(seed, clutter);
  const Recording& recording = mockup_run.recording;
  Localizer localizer(map, mockup_run.settings);
  localizer.start(recording.first_guess.pose, recording.first_guess.covariance);
  Trial trial;
  trial.truth = recording.truth;
  for (std::size_t i = 0; i < recording.scans.size(); ++i) {
    const Estimate& e = localizer.update(recording.scans[i], recording.odometry[i]);
    trial.estimates.push_back({e.stamp, e.pose, e.covariance, e.status, e.protection_m});
    times.add(localizer.timings());
    calls.push_back(localizer.match().calls);
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
  fmt::print("calls of the search: median {:.0f}, largest {:.0f}\n", quantile(calls, 0.5),
             quantile(calls, 1.0));
  fmt::print(
      "microseconds (median, p99): prediction {}, extraction {}, matching {}, estimation {}, cycle "
      "{}\n",
      spread(times.prediction), spread(times.extraction), spread(times.matching),
      spread(times.estimation), spread(times.total));
  return 0;
}

}  // namespace
}  // namespace adit

int main(int argc, char** argv) {
  constexpr std::int64_t kMost = 1000000;
  const auto argument = [&](int i, std::int64_t otherwise, std::int64_t least) {
    return argc > i ? adit::whole_number(argv[i], least, kMost) : std::optional(otherwise);
  };
  const auto runs = argument(1, 500, 1);
  const auto seed = argument(2, 1, 0);
  const auto clutter = argument(3, 8, 0);
  if (argc > 4 || !runs || !seed || !clutter) {
    fmt::print(stderr,
               "usage: mockup_trials [runs = 500] [first seed = 1] [pieces of clutter = 8]\n"
               "whole numbers up to {}; 1 run or more\n",
               kMost);
    return 2;
  }
  return adit::trials(static_cast<int>(*runs), static_cast<std::uint64_t>(*seed),
                      static_cast<int>(*clutter));
}
