#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <set>
#include <utility>

#include "adit/plot/figure_parts.hpp"
#include "adit/plot/figures.hpp"

namespace adit {
namespace {

/// Points on a grid of micrometres, so that equal ones compare equal after arithmetic.
class PointSet {
 public:
  void insert(const Vector2d& p) { cells_.insert(cell(p)); }
  bool contains(const Vector2d& p) const {
    const auto [x, y] = cell(p);
    for (std::int64_t dx = -1; dx <= 1; ++dx) {
      for (std::int64_t dy = -1; dy <= 1; ++dy) {
        if (cells_.count({x + dx, y + dy}) > 0) return true;
      }
    }
    return false;
  }

 private:
  using Cell = std::pair<std::int64_t, std::int64_t>;
  static Cell cell(const Vector2d& p) {
    constexpr double kCell = 1e-6;
    const Vector2d q = (p / kCell).cwiseMax(-4e18).cwiseMin(4e18);
    return {std::llround(q.x()), std::llround(q.y())};
  }
  std::set<Cell> cells_;
};

struct MapChanges {
  std::vector<Vector2d> cut;    ///< new vertices: crossings and T-junctions
  std::vector<Vector2d> moved;  ///< drawn ends that are no vertex any more
  std::vector<Vector2d> loose;  ///< vertices of one wall
};

MapChanges changes(std::span<const Segment> raw, const LineMap& cleaned) {
  PointSet drawn;
  for (const Segment& s : raw) {
    if (!s.is_finite()) continue;
    drawn.insert(s.a);
    drawn.insert(s.b);
  }
  MapChanges result;
  PointSet kept;
  const std::span<const Vector2d> vertices = cleaned.vertices();
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    kept.insert(vertices[i]);
    if (!drawn.contains(vertices[i])) result.cut.push_back(vertices[i]);
    if (cleaned.walls_at(static_cast<int>(i)).size() == 1) result.loose.push_back(vertices[i]);
  }
  PointSet told;
  for (const Segment& s : raw) {
    if (!s.is_finite()) continue;
    for (const Vector2d& end : {s.a, s.b}) {
      if (kept.contains(end) || told.contains(end)) continue;
      told.insert(end);
      result.moved.push_back(end);
    }
  }
  return result;
}

}  // namespace

std::vector<Segment> plan_of(const LineMap& map) {
  std::vector<Segment> plan;
  plan.reserve(map.walls().size());
  for (const Wall& wall : map.walls()) plan.push_back(wall.segment);
  return plan;
}

Result<void> draw_map(const std::string& path, std::span<const Segment> plan,
                      const PictureOptions& options) {
  Canvas canvas;
  canvas.segments(plan, wall_stroke(plan, {}, kWallColour));
  Sheet sheet(options);
  sheet.add(std::move(canvas));
  return sheet.write(path);
}

Result<void> draw_map_check(const std::string& path, std::span<const Segment> raw,
                            const LineMap& cleaned, const PictureOptions& options) {
  const std::vector<Segment> plan = plan_of(cleaned);
  const MapChanges found = changes(raw, cleaned);
  const auto size_of = [](const std::vector<Vector2d>& places, double size) {
    return places.size() > 300 ? 0.6 * size : size;
  };
  const MarkStyle loose{MarkShape::ring, size_of(found.loose, 5.4), kVermilion};
  const MarkStyle cut{MarkShape::dot, size_of(found.cut, 3.4), kBlue};
  const MarkStyle moved{MarkShape::plus, size_of(found.moved, 5.0), kOrange};
  Canvas canvas;
  canvas.segments(raw, {kPaleGrey, 1.6});
  canvas.segments(plan, wall_stroke(plan, {}, kWallColour));
  canvas.marks(found.loose, loose);
  canvas.marks(found.cut, cut);
  canvas.marks(found.moved, moved);
  Sheet sheet(options);
  sheet.add(std::move(canvas));
  const auto counted = [](const std::string& what, std::size_t count) {
    return what + " (" + std::to_string(count) + ")";
  };
  LegendEntry wall{counted("wall", plan.size()), Stroke{kWallColour, 0.9}, {}, {}, {}};
  LegendEntry drawn{counted("as drawn", raw.size()), Stroke{kPaleGrey, 1.6}, {}, {}, {}};
  sheet.explain(wall);
  sheet.explain(drawn);
  const auto explain = [&](const std::string& what, std::size_t count, const MarkStyle& mark) {
    if (count > 0) sheet.explain({counted(what, count), {}, mark, {}, {}});
  };
  explain("cut here", found.cut.size(), cut);
  explain("end moved or merged", found.moved.size(), moved);
  explain("loose end", found.loose.size(), loose);
  return sheet.write(path);
}

Result<void> draw_chart(const std::string& path, const Chart& chart,
                        const PictureOptions& options) {
  Sheet sheet(options);
  sheet.add(chart);
  for (const ChartSeries& series : chart.series) {
    if (!series.name.empty()) sheet.explain({series.name, series.stroke, series.mark, {}, {}});
  }
  for (const ChartLevel& level : chart.levels) {
    if (!level.name.empty()) sheet.explain({level.name, level.stroke, {}, {}, {}});
  }
  return sheet.write(path);
}

}  // namespace adit
