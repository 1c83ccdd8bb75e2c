#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "adit/plot/figure_parts.hpp"
#include "adit/plot/figures.hpp"
#include "adit/plot/ticks.hpp"

namespace adit {
namespace {

constexpr Stroke kReferencePath{kInk, 0.7, Dash::dotted};
constexpr std::size_t kManyPoses = 2000;  // from here on curves are thinner

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

/// What stands where a stretch of the run begins that is not `ok`: it may be a single pose.
std::optional<MarkStyle> mark_of(Status status) {
  switch (status) {
    case Status::ok:
      break;
    case Status::degraded:
      return MarkStyle{MarkShape::diamond, 3.0, colour_of(status)};
    case Status::ambiguous:
      return MarkStyle{MarkShape::square, 2.6, colour_of(status)};
    case Status::lost:
      return MarkStyle{MarkShape::cross, 4.0, colour_of(status)};
  }
  return std::nullopt;
}

bool begins_stretch(std::span<const TrajectoryPoint> run, std::size_t i, Status status) {
  const auto has_status = [&](std::size_t k) {
    return run[k].status.value_or(Status::ok) == status;
  };
  return has_status(i) && (i == 0 || !has_status(i - 1));
}

/// Where the stretches with one status begin.
std::vector<Vector2d> beginnings_of(std::span<const TrajectoryPoint> run, Status status) {
  std::vector<Vector2d> places;
  for (std::size_t i = 0; i < run.size(); ++i) {
    if (begins_stretch(run, i, status)) places.push_back(run[i].pose.translation());
  }
  return places;
}

/// The parts of the run with one status, each led up to by the pose before it.
std::vector<Vector2d> stretches_with(std::span<const TrajectoryPoint> run, Status status) {
  std::vector<Vector2d> points;
  for (std::size_t i = 0; i < run.size(); ++i) {
    if (run[i].status.value_or(Status::ok) != status) continue;
    if (i > 0 && begins_stretch(run, i, status)) {
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
    sheet.explain({name, Stroke{colour_of(status), 1.1}, mark_of(status), {}, {}});
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

/// The stretches of the run that are not `ok`, by scan.
std::vector<ChartBand> bands_of(std::span<const TrajectoryPoint> run) {
  std::vector<ChartBand> bands;
  for (std::size_t i = 0; i < run.size(); ++i) {
    const Status status = run[i].status.value_or(Status::ok);
    if (status == Status::ok) continue;
    const double at = static_cast<double>(i);
    if (begins_stretch(run, i, status)) {
      bands.push_back({at - 0.5, at, faded(colour_of(status), 0.35)});
    }
    bands.back().to = at + 0.5;
  }
  return bands;
}

/// The protection level from scan to scan, and the error that it must stay above; none where no
/// level is given.
std::optional<Chart> protection_chart(std::span<const TrajectoryPoint> run) {
  const double width = run.size() > kManyPoses ? 0.5 : 0.9;
  ChartSeries level{"protection level", {}, Stroke{kInk, width}, {}};
  ChartSeries error{"error", {}, Stroke{kGreen, 0.7 * width}, {}};
  bool has_level = false;
  for (std::size_t i = 0; i < run.size(); ++i) {
    const double at = static_cast<double>(i);
    const double protection = run[i].protection_m.value_or(NAN);
    has_level = has_level || std::isfinite(protection);
    level.points.emplace_back(at, protection);
    if (run[i].error_m) error.points.emplace_back(at, *run[i].error_m);
  }
  if (!has_level) return std::nullopt;
  Chart chart;
  chart.x_label = "scan";
  chart.y_label = "m";
  chart.log_y = true;
  chart.height_ratio = 0.28;
  chart.bands = bands_of(run);
  chart.series.push_back(std::move(level));
  if (!error.points.empty()) chart.series.push_back(std::move(error));
  return chart;
}

}  // namespace

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
    const double width = run.size() > kManyPoses ? 0.7 : 1.0;
    canvas.polyline(stretches_with(run, status),
                    {colour_of(status), status == Status::ok ? width : 1.4 * width});
    if (const auto mark = mark_of(status)) canvas.marks(beginnings_of(run, status), *mark);
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
  if (auto chart = protection_chart(run)) {
    for (const ChartSeries& series : chart->series) {
      sheet.explain({series.name, series.stroke, {}, {}, {}});
    }
    sheet.add(std::move(*chart));
  }
  return sheet.write(path);
}

}  // namespace adit
