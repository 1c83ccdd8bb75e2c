#include <algorithm>
#include <optional>
#include <utility>

#include "adit/plot/figure_parts.hpp"
#include "adit/plot/figures.hpp"

namespace adit {
namespace {

constexpr ArrowStyle kDesiredArrow{ArrowHead::open, 18.0, 0.8, kBlue};
constexpr ArrowStyle kEstimatedArrow{ArrowHead::filled, 11.0, 0.9, kVermilion};
constexpr Stroke kSurveyedPath{kInk, 1.2, Dash::dotted};
constexpr Stroke kEstimatedPath{kVermilion, 1.1};
constexpr std::size_t kFewPoses = 60;  // up to here each pose has its own mark

}  // namespace

Result<void> draw_motion_history(const std::string& path, std::span<const Segment> plan,
                                 std::span<const Pose2> desired, std::span<const Pose2> estimated,
                                 const PictureOptions& options) {
  Canvas canvas;
  canvas.show(focused_view(plan, joined(box_around(desired), box_around(estimated))));
  canvas.segments(plan, wall_stroke(plan, canvas.view(), kWallColour));
  canvas.polyline(translations(desired), {faded(kBlue, 0.5), 0.5});
  canvas.arrows(desired, kDesiredArrow);
  canvas.arrows(estimated, kEstimatedArrow);
  canvas.marks(translations(estimated), {MarkShape::dot, 2.4, kEstimatedArrow.colour});
  Sheet sheet(options);
  sheet.add(std::move(canvas));
  sheet.explain({"desired", Stroke{faded(kBlue, 0.5), 0.5}, {}, kDesiredArrow, {}});
  sheet.explain({"estimated", {}, {}, kEstimatedArrow, {}});
  return sheet.write(path);
}

Result<void> draw_paths(const std::string& path, std::span<const Segment> plan,
                        std::span<const Pose2> surveyed, std::span<const Pose2> estimated,
                        const PictureOptions& options) {
  std::optional<MarkStyle> place_mark;
  std::optional<MarkStyle> estimate_mark;
  if (std::max(surveyed.size(), estimated.size()) <= kFewPoses) {
    place_mark = MarkStyle{MarkShape::ring, 3.4, kSurveyedPath.colour};
    estimate_mark = MarkStyle{MarkShape::dot, 2.6, kEstimatedPath.colour};
  }
  Canvas canvas;
  canvas.show(focused_view(plan, joined(box_around(surveyed), box_around(estimated))));
  canvas.segments(plan, wall_stroke(plan, canvas.view(), kWallColour));
  canvas.polyline(translations(estimated), kEstimatedPath);
  canvas.polyline(translations(surveyed), kSurveyedPath);
  if (place_mark) canvas.marks(translations(surveyed), *place_mark);
  if (estimate_mark) canvas.marks(translations(estimated), *estimate_mark);
  Sheet sheet(options);
  sheet.add(std::move(canvas));
  sheet.explain({"surveyed path", kSurveyedPath, place_mark, {}, {}});
  sheet.explain({"estimated path", kEstimatedPath, estimate_mark, {}, {}});
  return sheet.write(path);
}

}  // namespace adit
