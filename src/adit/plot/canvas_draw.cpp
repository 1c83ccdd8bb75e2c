#include <algorithm>
#include <cmath>
#include <cstdint>
#include <unordered_set>

#include "adit/plot/canvas.hpp"
#include "adit/plot/labels.hpp"
#include "adit/plot/painter.hpp"
#include "adit/plot/ticks.hpp"

namespace adit {
namespace {

/// The places that the eye can tell apart, of so many that they would blacken the page.
std::vector<Vector2d> distinct(const std::vector<Vector2d>& places, double cell) {
  std::vector<Vector2d> kept;
  std::unordered_set<std::int64_t> seen;
  for (const Vector2d& p : places) {
    const std::int64_t column = std::llround(p.x() / cell);
    const std::int64_t row = std::llround(p.y() / cell);
    if (seen.insert(column * 1000003 + row).second) kept.push_back(p);
  }
  return kept;
}

}  // namespace

/// Draws the layers one by one and remembers the ink for the labels.
class Canvas::Renderer {
 public:
  Renderer(Painter& painter, const PageRect& area, const WorldToPage& map, bool with_labels)
      : painter_(painter), area_(area), map_(map), with_labels_(with_labels), placer_(area) {}

  void operator()(const PathLayer& layer) {
    const PathPoints path = to_page(layer.path, map_, area_.padded(10.0));
    painter_.stroke(path, layer.style);
    if (with_labels_) placer_.occupy(path, layer.style.width);
  }

  void operator()(const MarkLayer& layer) {
    std::vector<Vector2d> places;
    for (const Vector2d& place : layer.places) {
      const Vector2d p = map_(place);
      if (area_.padded(layer.style.size).contains(p)) places.push_back(p);
    }
    for (const Vector2d& p : distinct(places, 0.15)) {
      painter_.mark(p, layer.style);
      occupy_around(p, 0.5 * layer.style.size);
    }
  }

  void operator()(const ArrowLayer& layer) {
    for (const Pose2& pose : layer.poses) {
      const Vector2d p = map_(pose.translation());
      if (!area_.padded(layer.style.length).contains(p)) continue;
      painter_.arrow(p, pose.theta, layer.style);
      const Vector2d along(std::cos(pose.theta), -std::sin(pose.theta));
      occupy_around(p + layer.style.length * along, 2.0);
      occupy_around(p + 0.5 * layer.style.length * along, 1.0);
    }
  }

  void operator()(const AreaLayer& layer) {
    std::vector<Vector2d> corners;
    corners.reserve(layer.corners.size());
    for (const Vector2d& p : layer.corners) corners.push_back(map_(p));
    painter_.polygon(corners, layer.fill, layer.outline);
  }

  void labels(const std::vector<Label>& labels) {
    for (const Label& label : labels) {
      const Vector2d anchor = map_(label.place);
      if (!area_.contains(anchor)) continue;
      const Vector2d size = painter_.text_size(label.words, label.style);
      const LabelPlacer::Spot spot = placer_.place(anchor, label.clearance, size);
      if (spot.is_away) {
        const Vector2d end = anchor.cwiseMax(spot.box.min).cwiseMin(spot.box.max());
        painter_.line(anchor, end, {faded(label.style.colour, 0.5), 0.35});
      }
      if (spot.crowded) {
        const PageRect back = spot.box.padded(0.7);
        const Vector2d right(back.size.x(), 0.0);
        painter_.polygon(std::array{back.min, Vector2d(back.min + right), back.max(),
                                    Vector2d(back.max() - right)},
                         faded(kWhite, 0.75), std::nullopt);
      }
      painter_.text(spot.box.center(), label.words, label.style, {0, 0});
    }
  }

 private:
  void occupy_around(const Vector2d& p, double radius) {
    if (with_labels_) placer_.occupy(PageRect{p, Vector2d::Zero()}.padded(radius), 2);
  }

  Painter& painter_;
  PageRect area_;
  WorldToPage map_;
  bool with_labels_;
  LabelPlacer placer_;
};

namespace {

void draw_axes(Painter& painter, const PageRect& area, const WorldToPage& map) {
  constexpr double kTick = 3.0;
  const Stroke thin{kInk, 0.5};
  const Vector2d half = 0.5 / map.scale * area.size;
  const Vector2d lower = map.world_center - half;
  const Vector2d upper = map.world_center + half;
  const int most = std::clamp(static_cast<int>(area.size.minCoeff() / 45.0), 2, 8);
  const auto step_of = [](const std::vector<double>& v) {
    return v.size() > 1 ? v[1] - v[0] : 1.0;
  };
  const std::vector<double> xs = ticks(lower.x(), upper.x(), most);
  const std::vector<double> ys = ticks(lower.y(), upper.y(), most);
  for (const double x : xs) {
    const Vector2d at(map({x, 0.0}).x(), area.max().y());
    painter.line(at, at - Vector2d(0.0, kTick), thin);
    painter.text(at + Vector2d(0.0, 3.0), tick_text(x, step_of(xs)), kAxisText, {0, 1});
  }
  for (const double y : ys) {
    const Vector2d at(area.min.x(), map({0.0, y}).y());
    painter.line(at, at + Vector2d(kTick, 0.0), thin);
    painter.text(at - Vector2d(3.0, 0.0), tick_text(y, step_of(ys)), kAxisText, {-1, 0});
  }
  const Vector2d right(area.size.x(), 0.0);
  painter.polygon(
      std::array{area.min, Vector2d(area.min + right), area.max(), Vector2d(area.max() - right)},
      std::nullopt, thin);
}

}  // namespace

void Canvas::draw(Painter& painter, const PageRect& area, bool axes) const {
  const WorldToPage map{view().center(), area.center(), scale_in(area)};
  Renderer renderer(painter, area, map, !labels_.empty());
  painter.push_clip(area);
  for (const Layer& layer : layers_) std::visit(renderer, layer);
  renderer.labels(labels_);
  painter.pop_clip();
  if (axes) draw_axes(painter, area, map);
}

}  // namespace adit
