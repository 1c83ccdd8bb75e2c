#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "adit/plot/figure_parts.hpp"
#include "adit/plot/figures.hpp"
#include "adit/plot/ticks.hpp"

namespace adit {
namespace {

constexpr ArrowStyle kDesiredArrow{ArrowHead::open, 18.0, 0.8, kBlue};
constexpr ArrowStyle kEstimatedArrow{ArrowHead::filled, 11.0, 0.9, kVermilion};
constexpr Stroke kSurveyedPath{kInk, 1.2, Dash::dotted};
constexpr Stroke kReferencePath{kInk, 0.7, Dash::dotted};
constexpr Stroke kEstimatedPath{kVermilion, 1.1};
constexpr std::size_t kFewPoses = 60;  // up to here each pose has its own mark

constexpr std::array<Status, 4> kStatuses{Status::ok, Status::degraded, Status::ambiguous,
                                          Status::lost};

Colour colour_of(Status status) {
  switch (status) {
    case Status::ok:
      return kBlue;
    case Status::degraded:
      return kOrange;
    case Status::ambiguous:
      return kPurple;
    case Status::lost:
      break;
  }
  return kVermilion;
}

Box box_around(std::span<const Pose2> poses) {
  Box box;
  for (const Pose2& pose : poses) {
    if (pose.is_finite()) box.extend(pose.translation());
  }
  return box;
}

Box joined(Box a, const Box& b) {
  a.extend(b);
  return a;
}

/// The parts of the run with one status, each led up to by the pose before it.
std::vector<Vector2d> stretches_with(std::span<const TrajectoryPoint> run, Status status) {
  std::vector<Vector2d> points;
  for (std::size_t i = 0; i < run.size(); ++i) {
    if (run[i].status.value_or(Status::ok) != status) continue;
    const bool continues = i > 0 && run[i - 1].status.value_or(Status::ok) == status;
    if (!continues && i > 0) {
      points.emplace_back(Vector2d::Constant(NAN));  // lifts the pen
      points.push_back(run[i - 1].pose.translation());
    }
    points.push_back(run[i].pose.translation());
  }
  return points;
}

void add_ellipses(Canvas& canvas, std::span<const TrajectoryPoint> run, const Box& view,
                  const TrajectoryOptions& options) {
  const double sigmas = options.ellipse_sigmas * options.ellipse_magnification;
  if (!(sigmas > 0.0) || view.is_empty()) return;
  const double spacing = view.size().maxCoeff() / 35.0;
  std::optional<Vector2d> last;
  std::optional<Status> last_status;
  for (const TrajectoryPoint& point : run) {
    const Vector2d at = point.pose.translation();
    if (!point.covariance || !at.allFinite()) continue;
    const bool is_new = point.status != last_status;
    if (last && (at - *last).norm() < (is_new ? 0.25 : 1.0) * spacing) continue;
    last = at;
    last_status = point.status;
    const Colour colour = colour_of(point.status.value_or(Status::ok));
    canvas.ellipse(at, point.covariance->topLeftCorner<2, 2>(), sigmas, faded(colour, 0.14),
                   Stroke{faded(colour, 0.75), 0.4});
  }
}

void explain_trajectory(Sheet& sheet, std::span<const TrajectoryPoint> run,
                        const TrajectoryOptions& options, bool has_reference) {
  const bool has_status = std::any_of(
      run.begin(), run.end(), [](const TrajectoryPoint& p) { return p.status.has_value(); });
  for (const Status status : kStatuses) {
    const auto count = std::count_if(run.begin(), run.end(), [&](const TrajectoryPoint& p) {
      return p.status.value_or(Status::ok) == status;
    });
    if (count == 0) continue;
    const std::string name =
        has_status ? std::string(to_string(status)) + " (" + std::to_string(count) + ")" : "path";
    sheet.explain({name, Stroke{colour_of(status), 1.1}, {}, {}, {}});
  }
  if (has_reference) sheet.explain({"reference", kReferencePath, {}, {}, {}});
  const bool has_ellipses = options.ellipse_sigmas > 0.0 &&
                            std::any_of(run.begin(), run.end(), [](const TrajectoryPoint& p) {
                              return p.covariance && p.covariance->allFinite();
                            });
  if (!has_ellipses) return;
  std::string words = tick_text(options.ellipse_sigmas, 1.0) + "\u03c3 of the position";
  if (options.ellipse_magnification != 1.0) {
    words += ", drawn " + tick_text(options.ellipse_magnification, 1.0) + " times larger";
  }
  sheet.explain({words, {}, {}, {}, faded(kBlue, 0.25)});
}

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

Result<void> draw_trajectory(const std::string& path, std::span<const Segment> plan,
                             std::span<const TrajectoryPoint> run, std::span<const Pose2> reference,
                             const PictureOptions& options, const TrajectoryOptions& trajectory) {
  Box focus = box_around(reference);
  for (const TrajectoryPoint& point : run) {
    if (point.pose.is_finite()) focus.extend(point.pose.translation());
  }
  const Box everything = joined(box_around(plan), focus);
  const Box view = trajectory.whole_plan && !everything.is_empty()
                       ? everything.padded(0.03 * everything.size().maxCoeff())
                       : focused_view(plan, focus);
  Canvas canvas;
  canvas.show(view);
  canvas.segments(plan, wall_stroke(plan, view, kPlanColour));
  add_ellipses(canvas, run, view, trajectory);
  // The worst status last: it must not hide below the others.
  for (const Status status : kStatuses) {
    const double width = run.size() > 2000 ? 0.7 : 1.0;
    canvas.polyline(stretches_with(run, status),
                    {colour_of(status), status == Status::ok ? width : 1.4 * width});
  }
  canvas.polyline(translations(reference), kReferencePath);
  if (!run.empty()) {
    canvas.mark(run.front().pose.translation(), {MarkShape::ring, 5.0, kInk});
    canvas.mark(run.back().pose.translation(), {MarkShape::square, 4.0, kInk});
  }
  Sheet sheet(options);
  sheet.add(std::move(canvas));
  explain_trajectory(sheet, run, trajectory, !reference.empty());
  if (!run.empty()) {
    sheet.explain({"start", {}, MarkStyle{MarkShape::ring, 5.0, kInk}, {}, {}});
    sheet.explain({"end", {}, MarkStyle{MarkShape::square, 4.0, kInk}, {}, {}});
  }
  return sheet.write(path);
}

}  // namespace adit
