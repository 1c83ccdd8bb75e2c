#include <algorithm>
#include <utility>

#include "adit/plot/figure_parts.hpp"
#include "adit/plot/figures.hpp"

namespace adit {
namespace {

constexpr FeatureStyle kExtracted{kSensedColour, 1.3, 4.0, true};
constexpr ArrowStyle kHeading{ArrowHead::filled, 12.0, 0.8, kRobotColour};

}  // namespace

Result<void> draw_scan(const std::string& path, const ScanView& view,
                       const PictureOptions& options) {
  const Vector2d laser = view.map_from_laser.translation();
  std::vector<Vector2d> points;
  if (view.scan) points = returns_of(*view.scan, view.map_from_laser);
  Box focus;
  for (const Vector2d& p : points) {
    if (p.allFinite()) focus.extend(p);
  }
  if (laser.allFinite() && (view.scan || view.features)) focus.extend(laser);
  if (view.features) focus.extend(box_around(*view.features, view.map_from_laser));

  const MarkStyle point = range_point_style(points.size());
  Canvas canvas;
  canvas.show(view.plan.empty() && !focus.is_empty() ? focus.padded(0.04 * focus.size().maxCoeff())
                                                     : focused_view(view.plan, focus));
  const Stroke wall = wall_stroke(view.plan, canvas.view(), kBlue);
  canvas.segments(view.plan, wall);
  canvas.marks(points, point);
  if (view.features) add_features(canvas, *view.features, view.map_from_laser, kExtracted);
  canvas.arrows({&view.map_from_laser, 1}, kHeading);
  canvas.mark(laser, kRobotMark);

  Sheet sheet(options);
  sheet.add(std::move(canvas));
  if (!view.plan.empty()) sheet.explain({"plan", wall, {}, {}, {}});
  sheet.explain({"range point", {}, point, {}, {}});
  if (view.features) explain_features(sheet, kExtracted, "extracted ");
  sheet.explain({"scanner", {}, kRobotMark, {}, {}});
  return sheet.write(path);
}

}  // namespace adit
