#include "adit/plot/survey_figures.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "adit/plot/figure_parts.hpp"

namespace adit {
namespace {

constexpr Colour kBandColour{0.902, 0.624, 0.000, 0.35};
constexpr Stroke kTrajectory{kBlue, 0.6};
constexpr Stroke kClosure{faded(kVermilion, 0.5), 0.4};
constexpr ArrowStyle kStation{ArrowHead::filled, 8.0, 0.7, kBlue};
constexpr Stroke kRemoved{kVermilion, 1.6, Dash::dashed};
constexpr Stroke kAdded{kGreen, 1.8};

std::vector<Segment> segments_of(std::span<const DrawnWall> walls) {
  std::vector<Segment> segments;
  for (const DrawnWall& wall : walls) segments.push_back(wall.segment);
  return segments;
}

/// Where the wall may be: narrow at its middle and wider to its ends, by the turn.
void add_band(Canvas& canvas, const DrawnWall& wall, double sigmas) {
  const Segment& s = wall.segment;
  const double length = s.length();
  if (!(length > 0.0) || !std::isfinite(wall.offset_sigma_m + wall.angle_sigma_rad)) return;
  const Vector2d normal = perpendicular(s.b - s.a) / length;
  const double middle = sigmas * wall.offset_sigma_m;
  const double end = sigmas * std::hypot(wall.offset_sigma_m, 0.5 * length * wall.angle_sigma_rad);
  const Vector2d centre = 0.5 * (s.a + s.b);
  const std::array<Vector2d, 6> corners{s.a + end * normal,       centre + middle * normal,
                                        s.b + end * normal,       s.b - end * normal,
                                        centre - middle * normal, s.a - end * normal};
  canvas.area(corners, kBandColour, std::nullopt);
}

}  // namespace

Result<void> draw_survey(const std::string& path, const SurveyView& view,
                         const PictureOptions& options, const SurveyPictureOptions& survey) {
  const std::vector<Segment> walls = segments_of(view.walls);
  Canvas canvas;
  const bool bands = survey.band_sigmas > 0.0 && !walls.empty();
  if (bands) {
    for (const DrawnWall& wall : view.walls) add_band(canvas, wall, survey.band_sigmas);
  }
  std::vector<Segment> closures;
  for (const DrawnClosure& closure : view.closures) closures.push_back({closure.from, closure.to});
  canvas.segments(closures, kClosure);
  canvas.polyline(translations(view.trajectory), kTrajectory);
  canvas.segments(walls, wall_stroke(walls, {}, kWallColour));
  canvas.arrows(view.stations, kStation);
  canvas.marks(translations(view.stations), {MarkShape::dot, 2.4, kStation.colour});
  Sheet sheet(options);
  sheet.add(std::move(canvas));
  sheet.explain({"walls", Stroke{kWallColour, 0.7}, {}, {}, {}});
  if (bands) sheet.explain({"their uncertainty", {}, {}, {}, kBandColour});
  if (!view.trajectory.empty()) sheet.explain({"trajectory", kTrajectory, {}, {}, {}});
  if (!view.stations.empty()) {
    sheet.explain(
        {"stations (" + std::to_string(view.stations.size()) + ")", {}, {}, kStation, {}});
  }
  if (!view.closures.empty()) {
    sheet.explain({"loop closures (" + std::to_string(view.closures.size()) + ")",
                   Stroke{kVermilion, 0.6},
                   {},
                   {},
                   {}});
  }
  return sheet.write(path);
}

Result<void> draw_plan_changes(const std::string& path, std::span<const Segment> plan,
                               std::span<const DrawnChange> changes,
                               const PictureOptions& options) {
  Canvas canvas;
  canvas.segments(plan, wall_stroke(plan, {}, kPlanColour));
  bool removed = false;
  bool added = false;
  for (std::size_t i = 0; i < changes.size(); ++i) {
    const DrawnChange& change = changes[i];
    canvas.segments(change.removed, kRemoved);
    canvas.segments(change.added, kAdded);
    removed = removed || !change.removed.empty();
    added = added || !change.added.empty();
    const auto& pieces = change.added.empty() ? change.removed : change.added;
    if (pieces.empty()) continue;
    const Segment& middle = pieces[pieces.size() / 2];
    canvas.label(0.5 * (middle.a + middle.b), std::to_string(i + 1) + " " + change.name);
  }
  Sheet sheet(options);
  sheet.add(std::move(canvas));
  sheet.explain({"plan", Stroke{kPlanColour, 0.8}, {}, {}, {}});
  if (removed) sheet.explain({"not there any more", kRemoved, {}, {}, {}});
  if (added) sheet.explain({"surveyed, not in the plan", kAdded, {}, {}, {}});
  return sheet.write(path);
}

}  // namespace adit
