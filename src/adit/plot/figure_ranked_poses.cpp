#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>
#include <vector>

#include "adit/plot/figure_parts.hpp"
#include "adit/plot/figures.hpp"
#include "adit/plot/place_figures.hpp"

namespace adit {
namespace {

constexpr double kSigmas = 3.0;
constexpr Colour kBest = kBlue;
constexpr Colour kOther = kVermilion;

/// The size of a mark grows with the root of the weight: its area shows it.
double size_of(double weight) { return 2.5 + 5.0 * std::sqrt(std::clamp(weight, 0.0, 1.0)); }

/// Poses that hardly weigh anything pale.
Colour colour_of(std::size_t rank, double weight) {
  const Colour& hue = rank == 0 ? kBest : kOther;
  return faded(hue, std::clamp(0.35 + std::sqrt(std::max(0.0, weight)), 0.35, 1.0));
}

std::string in_percent(double weight) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3g %%", 100.0 * weight);
  return text;
}

void add_pose(Canvas& canvas, std::size_t rank, const WeightedPose& pose, bool numbered) {
  const Colour colour = colour_of(rank, pose.weight);
  const Vector2d place = pose.pose.translation();
  canvas.ellipse(place, pose.covariance.topLeftCorner<2, 2>(), kSigmas, faded(colour, 0.15),
                 Stroke{faded(colour, 0.6), 0.4});
  canvas.arrows({&pose.pose, 1}, {ArrowHead::filled, 12.0, 0.9, colour});
  canvas.mark(place, {MarkShape::dot, size_of(pose.weight), colour});
  if (numbered) canvas.label(place, std::to_string(rank + 1));
}

}  // namespace

Result<void> draw_ranked_poses(const std::string& path, const RankedPosesView& view,
                               const PictureOptions& options) {
  std::vector<Vector2d> points;
  if (view.scan != nullptr && !view.poses.empty()) {
    points = returns_of(*view.scan, view.poses.front().pose * view.scan->vehicle_from_laser);
  }
  Box focus;
  for (const Vector2d& point : points) {
    if (point.allFinite()) focus.extend(point);
  }
  for (const WeightedPose& pose : view.poses) {
    if (pose.pose.is_finite()) focus.extend(pose.pose.translation());
  }
  Canvas canvas;
  canvas.show(focused_view(view.plan, focus));
  const Stroke wall = wall_stroke(view.plan, canvas.view(), kWallColour);
  const MarkStyle point = range_point_style(points.size());
  canvas.segments(view.plan, wall);
  canvas.marks(points, {point.shape, point.size, kOrange});
  // The best last: nothing must hide it.
  for (std::size_t rank = view.poses.size(); rank-- > 0;) {
    add_pose(canvas, rank, view.poses[rank], view.poses.size() > 1);
  }
  Sheet sheet(options);
  sheet.add(std::move(canvas));
  sheet.explain({"plan", wall, {}, {}, {}});
  if (view.poses.empty()) return sheet.write(path);
  const double best = view.poses.front().weight;
  sheet.explain({"best pose (weight " + in_percent(best) + ")",
                 {},
                 MarkStyle{MarkShape::dot, size_of(best), colour_of(0, best)},
                 {},
                 {}});
  if (view.poses.size() > 1) {
    sheet.explain({"others (" + std::to_string(view.poses.size() - 1) + "), by their weight",
                   {},
                   MarkStyle{MarkShape::dot, size_of(0.25), kOther},
                   {},
                   {}});
  }
  if (!points.empty()) {
    sheet.explain(
        {"the scan from the best", {}, MarkStyle{point.shape, 2.0 * point.size, kOrange}, {}, {}});
  }
  sheet.explain({"3\u03c3 of the position", {}, {}, {}, faded(kBest, 0.25)});
  return sheet.write(path);
}

}  // namespace adit
