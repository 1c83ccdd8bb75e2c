#include <benchmark/benchmark.h>

#include "adit/extraction/extraction.hpp"
#include "support/mockup_run.hpp"

namespace adit {
namespace {

/// Checked first: every long line that the scan shows lies on a wall of the truth.
bool lines_lie_on_walls(const FeatureList& features, const Pose2& map_from_laser,
                        const World& world) {
  for (const Line& line : features.lines) {
    if (line.length() < 3.0) continue;
    const Vector2d middle = map_from_laser * Vector2d(0.5 * (line.begin + line.end));
    double nearest = 1e9;
    for (const Segment& wall : world.walls) nearest = std::min(nearest, distance(wall, middle));
    if (nearest > 0.15) return false;
  }
  return !features.lines.empty();
}

void extract_cyclone(benchmark::State& state) {
  const World world = test::cluttered_mockup(11, 8);
  const Recording recording = test::record_mockup(11, 8);
  const LocalizerSettings settings = test::mockup_settings();
  Extractor extractor;
  for (std::size_t i = 0; i < recording.scans.size(); ++i) {
    const FeatureList& features =
        extractor.extract(recording.scans[i], settings.scanner, settings.extraction);
    if (!lines_lie_on_walls(features, recording.truth[i].pose, world)) {
      state.SkipWithError("a long line lies off the walls");
      return;
    }
  }
  std::size_t i = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(extractor
                                 .extract(recording.scans[i % recording.scans.size()],
                                          settings.scanner, settings.extraction)
                                 .size());
    ++i;
  }
}
BENCHMARK(extract_cyclone)->Unit(benchmark::kMicrosecond);

/// A square room and a scanner of so many beams.
void extract_by_beams(benchmark::State& state) {
  World world = from_plan(outline(std::vector<Vector2d>{{-5, -4}, {6, -4}, {6, 5}, {-5, 5}}));
  ScannerSpec spec = sick();
  spec.beams = static_cast<int>(state.range(0));
  spec.first_bearing = -kPi;
  spec.bearing_step = kTwoPi / spec.beams;
  Random random(3);
  const LaserScan scan = simulate_scan(RayCaster(world.walls), {0.3, 0.2, 0.1}, spec, random);
  Extractor extractor;
  if (extractor.extract(scan, spec.model, {}).corners.size() != 4) {
    state.SkipWithError("a room has four corners");
    return;
  }
  for (auto _ : state) {
    benchmark::DoNotOptimize(extractor.extract(scan, spec.model, {}).size());
  }
  state.SetComplexityN(state.range(0));
}
BENCHMARK(extract_by_beams)
    ->RangeMultiplier(2)
    ->Range(250, 4000)
    ->Unit(benchmark::kMicrosecond)
    ->Complexity();

}  // namespace
}  // namespace adit
