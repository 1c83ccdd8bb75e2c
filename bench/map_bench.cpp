// Cleaning and indexing a plan, and the search for near walls, in plans of one local density.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "adit/map/line_map.hpp"
#include "support/draws.hpp"

namespace {

using adit::LineMap;
using adit::Segment;
using adit::Vector2d;

constexpr double kPitch = 20.0;  // of the pillars (m)
constexpr int kSides = 20;       // walls a pillar

// Points around a pillar, roughened: most merge with neither neighbour.
std::vector<Vector2d> pillar(const Vector2d& center, std::mt19937_64& random) {
  std::uniform_real_distribution<double> rough(-0.15, 0.15);
  std::vector<Vector2d> corners;
  for (int i = 0; i < kSides; ++i) {
    const double along = 4.0 * i / kSides;  // sides of a square of 14 m
    const double from_middle = 14.0 * (along - std::floor(along) - 0.5);
    const Vector2d point =
        adit::RigidTransform({center.x(), center.y(), std::floor(along) * adit::kPi / 2.0})
            .point({from_middle, -7.0});
    corners.push_back(point + adit::test::drawn<2>([&] { return rough(random); }));
  }
  return corners;
}

// A room-and-pillar panel as plans come: in mine coordinates, ends off by some millimetres, one
// wall in twenty drawn twice, one line in a hundred drawn across the others.
std::vector<Segment> panel(std::int64_t count, double* width = nullptr) {
  std::mt19937_64 random(1992);
  std::uniform_real_distribution<double> slip(-0.003, 0.003);
  const auto rows = static_cast<int>(std::ceil(std::sqrt(static_cast<double>(count) / kSides)));
  if (width != nullptr) *width = rows * kPitch;
  std::vector<Segment> raw;
  for (int cell = 0; static_cast<std::int64_t>(raw.size()) < count; ++cell) {
    const int row = cell / rows;
    const Vector2d center{500000.0 + kPitch * (cell % rows), 4500000.0 + kPitch * row};
    const auto corners = pillar(center, random);
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const Vector2d off{slip(random), slip(random)};
      raw.push_back({corners[i] + off, corners[(i + 1) % corners.size()]});
    }
    if (cell % 2 == 0) raw.push_back({raw.back().b, raw.back().a});
    if (cell % 5 == 0) raw.push_back({corners[0], corners[kSides / 2]});
  }
  raw.resize(static_cast<std::size_t>(count));
  std::shuffle(raw.begin(), raw.end(), random);
  return raw;
}

void build(benchmark::State& state) {
  const auto raw = panel(state.range(0));
  adit::MapReport report;
  for (auto _ : state) benchmark::DoNotOptimize(LineMap::build(raw, {}, &report));
  state.SetItemsProcessed(state.iterations() * state.range(0));
  state.counters["walls"] = static_cast<double>(report.output);
}
BENCHMARK(build)->Arg(10'000)->Arg(100'000)->Arg(1'000'000)->Unit(benchmark::kMillisecond);

// A drive of 0.5 m steps up and down the rooms, clear of the rim, where there is less to find.
void near_along_a_drive(benchmark::State& state) {
  double width = 0.0;
  const LineMap map = LineMap::build(panel(state.range(0), &width));
  const double radius = 50.0;
  const double rim = 3.0 * kPitch;
  const double rooms = std::floor((width - 2.0 * rim) / kPitch);
  const Vector2d start{500000.0 + rim, 4500000.0 + rim + kPitch / 2.0};
  std::vector<int> found;
  double driven = 0.0;
  std::int64_t walls = 0;
  for (auto _ : state) {
    const double lap = std::floor(driven / (kPitch * rooms));
    const Vector2d here =
        start + Vector2d(driven - lap * kPitch * rooms, kPitch * std::fmod(lap * 7.0, rooms));
    found.clear();
    map.near(here, radius, found);
    benchmark::DoNotOptimize(found.data());
    walls += static_cast<std::int64_t>(found.size());
    driven += 0.5;
  }
  state.counters["found"] = static_cast<double>(walls) / static_cast<double>(state.iterations());

  // What was timed is also right.
  found.clear();
  map.near(start, radius, found);
  const auto expected = std::count_if(
      map.walls().begin(), map.walls().end(),
      [&](const adit::Wall& wall) { return distance(wall.segment, start) <= radius; });
  if (static_cast<std::ptrdiff_t>(found.size()) != expected) state.SkipWithError("wrong walls");
}
BENCHMARK(near_along_a_drive)->Arg(10'000)->Arg(1'000'000)->Unit(benchmark::kMicrosecond);

}  // namespace
