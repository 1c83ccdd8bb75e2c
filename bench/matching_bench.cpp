// Matching at every stop of the paper's run with clutter, and of rooms with more clutter than
// walls.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <vector>

#include "adit/extraction/extraction.hpp"
#include "adit/matching/compatibility.hpp"
#include "adit/matching/matching.hpp"
#include "adit/prediction/prediction.hpp"
#include "adit/simulation/clutter.hpp"
#include "adit/simulation/ray_caster.hpp"
#include "adit/simulation/scanner.hpp"
#include "adit/simulation/world.hpp"
#include "support/synthetic_scene.hpp"

namespace adit {
namespace {

struct Case {
  FeatureList sensed;
  FeatureList model;
};

// The prediction errs by up to 0.2 m and 3 degrees, differently at each stop.
std::vector<Case> mockup_cases() {
  World world = mockup();
  world.path = mockup_path();
  add_clutter(world, clutter_of(8), 1);
  std::vector<Segment> around = fixed_segments(world);
  for (const Segment& side : people_at(world, 0.0)) around.push_back(side);
  const RayCaster caster(around);
  const ScannerSpec scanner = cyclone();
  const LineMap map = LineMap::build(world.plan);
  Random random(1);
  Extractor extractor;
  Visibility visibility;
  std::vector<Case> cases;
  for (std::size_t i = 0; i < world.path.size(); ++i) {
    const double phase = static_cast<double>(i);
    const Pose2 error{0.2 * std::cos(phase), 0.2 * std::sin(phase),
                      radians(3.0) * std::sin(2.0 * phase)};
    const Pose2 predicted = world.path[i] * error;
    const LaserScan scan = simulate_scan(caster, world.path[i], scanner, random);
    FeatureList visible;
    visibility.sweep(map, predicted.translation(), scanner.model.max_range_m);
    predict_features(map, visibility, predicted.translation(), {}, visible);
    Case& added = cases.emplace_back();
    added.sensed = extractor.extract(scan, scanner.model, {});
    transform(visible, Pose2{0.0, 0.0, -predicted.theta}, added.model);
  }
  return cases;
}

std::vector<Case> room_cases() {
  testing::SceneOptions options;
  options.boxes = 7;
  options.fragments = 0.2;
  options.lost_arms = 0.2;
  std::vector<Case> cases;
  for (std::uint64_t seed = 0; seed < 16; ++seed) {
    const testing::Scene scene = testing::SceneMaker(seed).make(options);
    cases.push_back({scene.sensed, scene.model});
  }
  return cases;
}

/// Size of the largest clique, by Bron and Kerbosch's enumeration with a pivot.
std::size_t largest_clique(const BitMatrix& graph, std::size_t size, std::vector<std::size_t> open,
                           std::vector<std::size_t> done) {
  if (open.empty() && done.empty()) return size;
  std::size_t pivot = open.empty() ? done.front() : open.front();
  std::ptrdiff_t most = -1;
  for (const auto* side : {&open, &done}) {
    for (const std::size_t v : *side) {
      const auto count =
          std::count_if(open.begin(), open.end(), [&](std::size_t u) { return graph.test(u, v); });
      if (count > most) {
        most = count;
        pivot = v;
      }
    }
  }
  std::size_t best = 0;
  for (const std::size_t v : std::vector<std::size_t>(open)) {
    if (graph.test(pivot, v)) continue;
    const auto neighbours = [&](const std::vector<std::size_t>& of) {
      std::vector<std::size_t> kept;
      std::copy_if(of.begin(), of.end(), std::back_inserter(kept),
                   [&](std::size_t u) { return graph.test(u, v); });
      return kept;
    };
    best = std::max(best, largest_clique(graph, size + 1, neighbours(open), neighbours(done)));
    open.erase(std::find(open.begin(), open.end(), v));
    done.push_back(v);
  }
  return best;
}

std::size_t largest_consistent_set(const Case& input, const MatchingOptions& options) {
  FeatureViews sensed;
  FeatureViews model;
  CandidateList candidates;
  BitMatrix compatible;
  std::vector<std::int64_t> weights;
  make_views(input.sensed, options, sensed);
  make_views(input.model, options, model);
  find_candidates(sensed, model, options, candidates);
  find_compatible(sensed, model, candidates, options, compatible, weights);
  std::vector<std::size_t> all;
  for (std::size_t i = 0; i < candidates.pairs.size(); ++i) all.push_back(i);
  return largest_clique(compatible, 0, all, {});
}

void match_cases(benchmark::State& state, const std::vector<Case>& cases,
                 const MatchingOptions& options) {
  Matcher matcher;
  double candidates = 0.0;
  double pairs = 0.0;
  double calls = 0.0;
  for (const Case& input : cases) {
    const MatchResult result = matcher.match(input.sensed, input.model, options);
    const bool is_largest = options.consistency == Consistency::paper ||
                            result.pairs.size() == largest_consistent_set(input, options);
    if (!result.is_maximum || !is_largest) {
      state.SkipWithError("the set is not the largest");
      return;
    }
    candidates += result.candidates;
    pairs += static_cast<double>(result.pairs.size());
    calls += result.calls;
  }
  std::size_t next = 0;
  for (auto _ : state) {
    const Case& input = cases[next++ % cases.size()];
    benchmark::DoNotOptimize(matcher.match(input.sensed, input.model, options).pairs.data());
  }
  const auto count = static_cast<double>(cases.size());
  state.counters["candidates"] = candidates / count;
  state.counters["pairs"] = pairs / count;
  state.counters["calls"] = calls / count;
}

MatchingOptions from_prior() {
  return tolerances_from_prior({}, Vector3d(0.01, 0.01, 0.001).asDiagonal());
}

MatchingOptions with(Consistency consistency) {
  MatchingOptions options;
  options.consistency = consistency;
  return options;
}

void match_mockup(benchmark::State& state) { match_cases(state, mockup_cases(), from_prior()); }
BENCHMARK(match_mockup)->Unit(benchmark::kMicrosecond);

void match_mockup_wide(benchmark::State& state) {
  match_cases(state, mockup_cases(), with(Consistency::clique));
}
BENCHMARK(match_mockup_wide)->Unit(benchmark::kMicrosecond);

void match_mockup_paper(benchmark::State& state) {
  match_cases(state, mockup_cases(), with(Consistency::paper));
}
BENCHMARK(match_mockup_paper)->Unit(benchmark::kMicrosecond);

void match_cluttered_room(benchmark::State& state) {
  match_cases(state, room_cases(), with(Consistency::clique));
}
BENCHMARK(match_cluttered_room)->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace adit
