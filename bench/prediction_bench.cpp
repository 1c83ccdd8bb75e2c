// Visibility and prediction: the paper's mockup, a dense panel, and a drive through plans of equal
// density and very different size.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <vector>

#include "adit/evaluation/statistics.hpp"
#include "adit/prediction/prediction.hpp"

namespace adit {
namespace {

constexpr double kMaxRange = 50.0;

void add_chain(std::vector<Segment>& segments, const std::vector<Vector2d>& points) {
  for (std::size_t i = 1; i < points.size(); ++i) segments.push_back({points[i - 1], points[i]});
}

/// Two crossing corridors of 6 m in 20 x 30 m, with three 0.4 m columns on the left wall: 29 walls.
std::vector<Segment> mockup_like() {
  std::vector<Segment> segments;
  add_chain(segments, {{0, 0},
                       {0, 6},
                       {0.4, 6},
                       {0.4, 6.4},
                       {0, 6.4},
                       {0, 12},
                       {0.4, 12},
                       {0.4, 12.4},
                       {0, 12.4},
                       {0, 18},
                       {0.4, 18},
                       {0.4, 18.4},
                       {0, 18.4},
                       {0, 30},
                       {6, 30},
                       {6, 19},
                       {20, 19}});
  add_chain(segments, {{0, 0}, {20, 0}, {20, 6}, {6, 6}, {6, 13}, {20, 13}});
  add_chain(segments, {{9, 8}, {12, 8}, {12, 11}, {9, 11}, {9, 8}});
  add_chain(segments, {{14, 22}, {18, 22}, {18, 27}, {14, 27}});
  segments.push_back({Vector2d(10, 25), Vector2d(12, 28)});
  return segments;
}

/// Room and pillar: pillars of 18 m, rooms of 6 m, each pillar wall in `pieces` slightly wavy
/// pieces.
std::vector<Segment> panel(int columns, int rows, int pieces) {
  std::vector<Segment> segments;
  segments.reserve(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows) * 4u *
                   static_cast<std::size_t>(pieces));
  for (int column = 0; column < columns; ++column) {
    for (int row = 0; row < rows; ++row) {
      std::vector<Vector2d> points;
      const Vector2d corner(24.0 * column + 6.0, 24.0 * row + 6.0);
      const Vector2d turn[] = {{1, 0}, {0, 1}, {-1, 0}, {0, -1}};
      Vector2d at = corner;
      for (const Vector2d& along : turn) {
        for (int i = 0; i < pieces; ++i) {
          const double wave = i == 0 ? 0.0 : 0.2 * std::sin(2.1 * i + column + 3.0 * row);
          points.push_back(at + along * (18.0 * i / pieces) + perpendicular(along) * wave);
        }
        at += 18.0 * along;
      }
      points.push_back(corner);
      add_chain(segments, points);
    }
  }
  return segments;
}

struct Stage {
  Visibility visibility;
  FeatureList features;
  PredictionOptions options;

  void run(const LineMap& map, const Vector2d& observer) {
    visibility.sweep(map, observer, kMaxRange);
    predict_features(map, visibility, observer, options, features);
  }
};

/// Places along the middle of the mockup's corridors.
std::vector<Vector2d> mockup_path() {
  std::vector<Vector2d> path;
  for (double x = 16.0; x > 3.0; x -= 1.6) path.push_back({x, 3.1});
  for (double y = 3.3; y < 15.0; y += 1.6) path.push_back({3.4, y});
  for (double x = 4.0; x < 16.0; x += 1.6) path.push_back({x, 16.2});
  return path;
}

void visibility_sweep_mockup(benchmark::State& state) {
  const LineMap map = LineMap::build(mockup_like());
  const std::vector<Vector2d> path = mockup_path();
  Visibility visibility;
  std::size_t i = 0;
  for (auto _ : state) {
    visibility.sweep(map, path[i++ % path.size()], kMaxRange);
    benchmark::DoNotOptimize(visibility.intervals().data());
  }
}
BENCHMARK(visibility_sweep_mockup);

void visibility_ranges_of_1000_beams(benchmark::State& state) {
  const LineMap map = LineMap::build(mockup_like());
  Visibility visibility;
  visibility.sweep(map, Vector2d(3.4, 12.0), kMaxRange);
  std::vector<double> ranges(1000);
  std::vector<int> walls(1000);
  for (auto _ : state) {
    visibility.ranges(0.3, kTwoPi / 1000.0, ranges, walls);
    benchmark::DoNotOptimize(ranges.data());
  }
}
BENCHMARK(visibility_ranges_of_1000_beams);

void prediction_mockup(benchmark::State& state) {
  const LineMap map = LineMap::build(mockup_like());
  const std::vector<Vector2d> path = mockup_path();
  Stage stage;
  std::size_t i = 0;
  std::size_t features = 0;
  for (auto _ : state) {
    stage.run(map, path[i++ % path.size()]);
    features += stage.features.size();
  }
  state.counters["features"] =
      benchmark::Counter(static_cast<double>(features), benchmark::Counter::kAvgIterations);
}
BENCHMARK(prediction_mockup);

/// Argument: pieces a pillar wall; 1 is 4 walls a pillar, 32 puts over 1000 walls within range.
void prediction_panel(benchmark::State& state) {
  const LineMap map = LineMap::build(panel(12, 12, static_cast<int>(state.range(0))));
  Stage stage;
  std::vector<int> near;
  map.near(Vector2d(147.0, 147.0), kMaxRange, near);
  double x = 80.0;
  for (auto _ : state) {
    stage.run(map, Vector2d(x, 147.0));
    x = x < 200.0 ? x + 0.5 : 80.0;
  }
  state.counters["walls_in_range"] = static_cast<double>(near.size());
  state.counters["features"] = static_cast<double>(stage.features.size());
}
BENCHMARK(prediction_panel)->Arg(1)->Arg(8)->Arg(32);

/// Argument: segments in the plan. The median is that of the single calls along one drive; it is to
/// be the same for all sizes.
void prediction_drive(benchmark::State& state) {
  constexpr int kPieces = 4;
  const int side = static_cast<int>(
      std::lround(std::sqrt(static_cast<double>(state.range(0)) / (4.0 * kPieces))));
  const LineMap map = LineMap::build(panel(side, side, kPieces));
  const int half = side / 2;
  const double middle = 24.0 * half;
  Stage stage;
  std::vector<double> times;
  for (auto _ : state) {
    for (double along = -200.0; along < 200.0; along += 0.2) {
      const Vector2d observer(middle + along, middle + 3.0 + 0.5 * std::sin(along));
      const auto start = std::chrono::steady_clock::now();
      stage.run(map, observer);
      const std::chrono::duration<double, std::micro> taken =
          std::chrono::steady_clock::now() - start;
      times.push_back(taken.count());
    }
  }
  std::sort(times.begin(), times.end());
  state.counters["median_us"] = percentile(times, 0.5);
  state.counters["walls"] = static_cast<double>(map.walls().size());
}
BENCHMARK(prediction_drive)->Arg(10'000)->Arg(1'000'000)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace adit
