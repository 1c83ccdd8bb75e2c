// A mine of a million segments: from CSV to a cleaned, indexed map, and what prediction costs along
// a drive in it, against a mine of ten thousand of the same density. Prints the figures of
// docs/benchmarks.md.
//
//   scale_trials [folder for the temporary plan = .]

#include <fmt/core.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <string>
#include <vector>

#include "adit/evaluation/statistics.hpp"
#include "adit/io/plan.hpp"
#include "adit/map/line_map.hpp"
#include "adit/prediction/prediction.hpp"
#include "adit/simulation/random.hpp"

namespace adit {
namespace {

constexpr double kPitch = 20.0;   // from pillar to pillar (m)
constexpr double kPillar = 14.0;  // side of a pillar (m)
constexpr double kRange = 50.0;   // of the Cyclone (m)
const Vector2d kOrigin(512000.0, 4500000.0);

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// A panel of side * side pillars whose walls are drawn as a draughtsman would, off by millimetres,
/// in mine coordinates.
std::vector<Segment> pillars(int side) {
  Random random(1);
  std::vector<Segment> walls;
  const auto jitter = [&]() -> Vector2d {
    return {0.004 * random.uniform(), 0.004 * random.uniform()};
  };
  for (int row = 0; row < side; ++row) {
    for (int column = 0; column < side; ++column) {
      const double up = random.uniform();
      const double aside = random.uniform();
      const Vector2d low = kOrigin + Vector2d(column * kPitch, row * kPitch) + Vector2d(aside, up);
      const Vector2d high = low + Vector2d(kPillar, kPillar);
      walls.push_back({low + jitter(), Vector2d(high.x(), low.y()) + jitter()});
      walls.push_back({Vector2d(high.x(), low.y()) + jitter(), high + jitter()});
      walls.push_back({high + jitter(), Vector2d(low.x(), high.y()) + jitter()});
      walls.push_back({Vector2d(low.x(), high.y()) + jitter(), low + jitter()});
    }
  }
  return walls;
}

/// Places along the entries near the middle of a panel of side * side pillars.
std::vector<Vector2d> drive(int side) {
  std::vector<Vector2d> places;
  const int middle = side / 2;
  const double entry = kOrigin.y() + middle * kPitch - 2.5;
  for (int i = 0; i < 2000; ++i) places.emplace_back(kOrigin.x() + 100.0 + 0.3 * i, entry);
  return places;
}

class Predictor {
 public:
  explicit Predictor(int side) : map_(LineMap::build(pillars(side))), places_(drive(side)) {}
  std::size_t size() const { return places_.size(); }
  std::size_t walls() const { return map_.walls().size(); }
  std::size_t features() const { return features_.size(); }

  /// Seconds of one prediction.
  double at(std::size_t i) {
    const auto start = std::chrono::steady_clock::now();
    visibility_.sweep(map_, places_[i], kRange);
    predict_features(map_, visibility_, places_[i], {}, features_);
    return seconds_since(start);
  }

 private:
  LineMap map_;
  std::vector<Vector2d> places_;
  Visibility visibility_;
  FeatureList features_;
};

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return percentile(values, 0.5);
}

void compare_prediction() {
  Predictor small(50), large(500);
  std::vector<double> in_small, in_large;
  for (int round = 0; round < 5; ++round) {
    for (std::size_t i = 0; i < small.size(); ++i) {
      in_small.push_back(small.at(i));
      in_large.push_back(large.at(i));
    }
  }
  fmt::print(
      "prediction along a drive, median: {:.1f} us in {} walls, {:.1f} us in {} walls, ratio "
      "{:.2f}\n",
      1e6 * median(in_small), small.walls(), 1e6 * median(in_large), large.walls(),
      median(in_large) / median(in_small));
}

int read_and_build(const std::filesystem::path& folder) {
  const std::filesystem::path file = folder / "scale-trial-plan.csv";
  if (const auto written = write_plan(pillars(500), file.string()); !written) {
    fmt::print(stderr, "{}\n", to_string(written.error()));
    return 1;
  }
  std::vector<double> totals;
  for (int round = 0; round < 3; ++round) {
    const auto start = std::chrono::steady_clock::now();
    const auto plan = read_plan(file.string());
    const double reading = seconds_since(start);
    if (!plan) {
      fmt::print(stderr, "{}\n", to_string(plan.error()));
      return 1;
    }
    const LineMap map = LineMap::build(plan->segments);
    totals.push_back(seconds_since(start));
    fmt::print("{} segments: read in {:.2f} s, cleaned and indexed in {:.2f} s, {} walls\n",
               plan->segments.size(), reading, totals.back() - reading, map.walls().size());
  }
  std::filesystem::remove(file);
  fmt::print("from CSV to map, median of 3: {:.2f} s\n", median(totals));
  return 0;
}

}  // namespace
}  // namespace adit

int main(int argc, char** argv) {
  const std::filesystem::path folder = argc > 1 ? argv[1] : ".";
  std::error_code code;
  if (argc > 2 || !std::filesystem::is_directory(folder, code)) {
    fmt::print(stderr, "usage: scale_trials [folder for the temporary plan = .]\n");
    return 2;
  }
  adit::compare_prediction();
  return adit::read_and_build(folder);
}
