#include <fmt/core.h>

#include <algorithm>

#include "adit/evaluation/statistics.hpp"
#include "adit/io/plan.hpp"
#include "adit/map/line_map.hpp"
#include "commands.hpp"
#include "report_error.hpp"

namespace adit {
namespace {

struct Cleaned {
  Plan plan;
  LineMap map;
  MapReport report;
};

Result<Cleaned> read_and_clean(const std::string& path) {
  return read_plan(path).map([](Plan plan) {
    Cleaned cleaned;
    cleaned.map = LineMap::build(plan.segments, {}, &cleaned.report);
    cleaned.plan = std::move(plan);
    return cleaned;
  });
}

std::vector<Segment> segments_of(const LineMap& map) {
  std::vector<Segment> segments;
  for (const Wall& wall : map.walls()) segments.push_back(wall.segment);
  return segments;
}

/// Vertices where exactly one wall ends: the plan has a gap or a free-standing wall there.
std::ptrdiff_t open_ends(const LineMap& map) {
  std::ptrdiff_t count = 0;
  for (std::size_t v = 0; v < map.vertices().size(); ++v) {
    if (map.walls_at(static_cast<int>(v)).size() == 1) ++count;
  }
  return count;
}

}  // namespace

int run_map_info(const MapArguments& arguments) {
  const auto cleaned = read_and_clean(arguments.plan);
  if (!cleaned) return report(cleaned.error());
  const LineMap& map = cleaned->map;
  std::vector<double> lengths;
  double total = 0.0;
  Vector2d low = Vector2d::Constant(INFINITY);
  Vector2d high = -low;
  for (const Wall& wall : map.walls()) {
    lengths.push_back(wall.segment.length());
    total += lengths.back();
    low = low.cwiseMin(wall.segment.a).cwiseMin(wall.segment.b);
    high = high.cwiseMax(wall.segment.a).cwiseMax(wall.segment.b);
  }
  fmt::print("{}: {} segments, {} walls after cleaning, {} vertices, {} open ends\n",
             arguments.plan, cleaned->plan.segments.size(), map.walls().size(),
             map.vertices().size(), open_ends(map));
  if (map.empty()) return kDone;
  std::sort(lengths.begin(), lengths.end());
  fmt::print("x {:.3f} to {:.3f} m, y {:.3f} to {:.3f} m: {:.1f} x {:.1f} m\n", low.x(), high.x(),
             low.y(), high.y(), high.x() - low.x(), high.y() - low.y());
  fmt::print("walls {:.1f} m in all; shortest {:.3f}, median {:.3f}, longest {:.3f} m\n", total,
             lengths.front(), percentile(lengths, 0.5), lengths.back());
  return kDone;
}

int run_map_check(const MapArguments& arguments) {
  const auto cleaned = read_and_clean(arguments.plan);
  if (!cleaned) return report(cleaned.error());
  for (const Warning& warning : cleaned->plan.warnings) {
    fmt::print("{}: {}\n", arguments.plan, to_string(warning));
  }
  const MapReport& r = cleaned->report;
  fmt::print("{:8} segments read\n", r.input);
  fmt::print("{:8} not finite, dropped\n", r.not_finite);
  fmt::print("{:8} of zero length, dropped\n", r.zero_length);
  fmt::print("{:8} ends that missed a vertex or a wall by a little, snapped\n", r.snapped_ends);
  fmt::print("{:8} crossings without a vertex, split\n", r.crossings);
  fmt::print("{:8} T-junctions without a vertex, split\n", r.t_junctions);
  fmt::print("{:8} duplicates, dropped\n", r.duplicates);
  fmt::print("{:8} collinear neighbours, joined\n", r.merged);
  fmt::print("{:8} walls\n", r.output);
  fmt::print("{:8} open ends (where one wall ends alone)\n", open_ends(cleaned->map));
  const bool dirty =
      r.not_finite + r.zero_length + r.snapped_ends + r.crossings + r.t_junctions + r.duplicates >
      0;
  fmt::print("{}\n", dirty ? "needs cleaning; adit cleans it whenever it reads it" : "clean");
  return dirty ? kFailed : kDone;
}

int run_map_convert(const MapArguments& arguments) {
  const auto cleaned = read_and_clean(arguments.plan);
  if (!cleaned) return report(cleaned.error());
  if (const auto written = write_plan(segments_of(cleaned->map), arguments.output); !written) {
    return report(written.error());
  }
  fmt::print("{} walls written to {}\n", cleaned->map.walls().size(), arguments.output);
  return kDone;
}

}  // namespace adit
