#include <algorithm>
#include <cmath>
#include <utility>

#include "adit/geometry/moments.hpp"
#include "adit/plot/figure_parts.hpp"
#include "adit/plot/figures.hpp"

namespace adit {
namespace {

constexpr MarkStyle kScanPoint{MarkShape::dot, 1.5, kScanColour};
constexpr Stroke kPeakArm{kVermilion, 1.6};
constexpr Stroke kOtherArm{kSkyBlue, 1.1};
constexpr Stroke kThreshold{kGrey, 0.8, Dash::dashed};

double reach(const OperatorPosition& at) {
  return 0.5 * ((at.left_end - at.vertex).norm() + (at.right_end - at.vertex).norm());
}

/// Whether no response within an arm of this one, walking along the scan, is stronger.
bool is_local_maximum(const CornerOperatorView& view, std::size_t i) {
  const OperatorPosition& at = view.positions[i];
  const auto is_near = [&](const OperatorPosition& other) {
    return (other.vertex - at.vertex).norm() < reach(at);
  };
  for (std::size_t k = i; k > 0 && is_near(view.positions[k - 1]); --k) {
    if (view.positions[k - 1].gain >= at.gain) return false;
  }
  for (std::size_t k = i + 1; k < view.positions.size() && is_near(view.positions[k]); ++k) {
    if (view.positions[k].gain > at.gain) return false;
  }
  return true;
}

/// The strongest local maxima above the threshold, in the order of the scan.
std::vector<std::size_t> peaks(const CornerOperatorView& view) {
  constexpr std::size_t kMost = 30;
  std::vector<std::size_t> found;
  for (std::size_t i = 0; i < view.positions.size(); ++i) {
    if (view.positions[i].gain >= view.threshold && is_local_maximum(view, i)) found.push_back(i);
  }
  std::stable_sort(found.begin(), found.end(), [&](std::size_t a, std::size_t b) {
    return view.positions[a].gain > view.positions[b].gain;
  });
  if (found.size() > kMost) found.resize(kMost);
  std::sort(found.begin(), found.end());
  return found;
}

/// Quarter turns that let the stretch run from left to right, so that it lies above its curve.
double lying(const CornerOperatorView& view) {
  if (view.points.size() < 2) return 0.0;
  const Vector2d along = view.points.back() - view.points.front();
  if (!along.allFinite()) return 0.0;
  return -0.5 * kPi * std::round(std::atan2(along.y(), along.x()) / (0.5 * kPi));
}

CornerOperatorView turned(CornerOperatorView view, double angle) {
  const RigidTransform turn(Pose2{0.0, 0.0, angle});
  for (Vector2d& p : view.points) p = turn.point(p);
  for (OperatorPosition& at : view.positions) {
    at = {turn.point(at.vertex), turn.point(at.left_end), turn.point(at.right_end), at.gain};
  }
  return view;
}

/// A few positions at even spaces, clear of the peaks.
std::vector<std::size_t> examples(const CornerOperatorView& view,
                                  const std::vector<std::size_t>& found) {
  constexpr std::size_t kMost = 8;
  std::vector<std::size_t> chosen;
  const auto is_clear = [&](std::size_t i, const std::vector<std::size_t>& of) {
    return std::none_of(of.begin(), of.end(), [&](std::size_t k) {
      const double apart = (view.positions[k].vertex - view.positions[i].vertex).norm();
      return apart < 1.5 * reach(view.positions[i]);
    });
  };
  const std::size_t stride = std::max<std::size_t>(1, view.positions.size() / 500);
  for (std::size_t i = 0; i < view.positions.size(); i += stride) {
    if (is_clear(i, found) && is_clear(i, chosen)) chosen.push_back(i);
  }
  std::vector<std::size_t> spread;
  for (std::size_t n = 0; n < std::min(kMost, chosen.size()); ++n) {
    spread.push_back(chosen[n * chosen.size() / std::min(kMost, chosen.size())]);
  }
  return spread;
}

void add_operator(Canvas& canvas, const OperatorPosition& at, const Stroke& stroke, double size) {
  const std::vector<Vector2d> arms{at.left_end, at.vertex, at.right_end};
  canvas.polyline(arms, stroke);
  canvas.mark(at.vertex, {MarkShape::dot, size, stroke.colour});
}

Chart response_chart(const CornerOperatorView& view, const std::vector<std::size_t>& found) {
  Chart chart;
  chart.x_label = "point of the scan";
  chart.y_label = "response (\u03c7\u00b2 gained)";
  chart.height_ratio = 0.36;
  ChartSeries curve;
  double highest = 0.0;
  for (const OperatorPosition& at : view.positions) highest = std::max(highest, at.gain);
  chart.log_y = highest > 20.0 * view.threshold && view.threshold > 0.0;
  const double floor = chart.log_y ? 0.1 * view.threshold : -HUGE_VAL;
  const auto value = [&](std::size_t i) {
    return Vector2d(static_cast<double>(i), std::max(floor, view.positions[i].gain));
  };
  for (std::size_t i = 0; i < view.positions.size(); ++i) curve.points.push_back(value(i));
  curve.stroke = Stroke{kBlue, 0.8};
  ChartSeries tops;
  tops.stroke.reset();
  tops.mark = MarkStyle{MarkShape::dot, 4.0, kVermilion};
  for (std::size_t n = 0; n < found.size(); ++n) {
    tops.points.push_back(value(found[n]));
    chart.labels.push_back({tops.points.back(), std::to_string(n + 1), kNumberText});
  }
  chart.series = {std::move(curve), std::move(tops)};
  chart.levels.push_back({"", view.threshold, kThreshold});
  return chart;
}

Vector2d foot(const LineFit& line, const Vector2d& p) {
  return line.centroid + line.direction.dot(p - line.centroid) * line.direction;
}

/// Where the two lines meet; the point itself where they are too parallel to tell.
Vector2d meeting(const LineFit& left, const LineFit& right, const Vector2d& point) {
  const double sine = cross(left.direction, right.direction);
  if (std::abs(sine) < 0.2) return 0.5 * (foot(left, point) + foot(right, point));
  const Vector2d between = right.centroid - left.centroid;
  return left.centroid + cross(between, right.direction) / sine * left.direction;
}

}  // namespace

CornerOperatorView slide_corner_operator(std::span<const Vector2d> points, double arm_m,
                                         double sigma_m, double threshold) {
  constexpr std::size_t kFewest = 4;  // points of an arm
  CornerOperatorView view{{points.begin(), points.end()}, {}, threshold};
  const auto fit = [&](std::size_t begin, std::size_t end) {
    Moments moments;  // about a near point, so that large coordinates cost no digits
    for (const Vector2d& p : points.subspan(begin, end - begin)) {
      moments.add(p.x() - points[begin].x(), p.y() - points[begin].y());
    }
    LineFit line = fit_line(moments);
    line.centroid += points[begin];
    return line;
  };
  for (std::size_t i = 0; i < points.size(); ++i) {
    std::size_t first = i;
    std::size_t last = i;
    const auto is_near = [&](std::size_t k) { return (points[k] - points[i]).norm() <= arm_m; };
    while (first > 0 && is_near(first - 1)) --first;
    while (last + 1 < points.size() && is_near(last + 1)) ++last;
    if (i - first < kFewest || last - i < kFewest) continue;
    const LineFit left = fit(first, i + 1);
    const LineFit right = fit(i, last + 1);
    const double one = fit(first, last + 1).squared_error;
    const double gain = (one - left.squared_error - right.squared_error) / (sigma_m * sigma_m);
    view.positions.push_back({meeting(left, right, points[i]), foot(left, points[first]),
                              foot(right, points[last]), gain});
  }
  return view;
}

Result<void> draw_corner_operator(const std::string& path, const CornerOperatorView& given,
                                  const PictureOptions& options) {
  const CornerOperatorView view = turned(given, lying(given));
  const std::vector<std::size_t> found = peaks(view);
  Canvas canvas;
  canvas.marks(view.points, kScanPoint);
  for (const std::size_t i : examples(view, found)) {
    add_operator(canvas, view.positions[i], kOtherArm, 3.0);
  }
  for (std::size_t n = 0; n < found.size(); ++n) {
    add_operator(canvas, view.positions[found[n]], kPeakArm, 4.0);
    canvas.label(view.positions[found[n]].vertex, std::to_string(n + 1));
  }
  Sheet sheet(options);
  sheet.add(std::move(canvas));
  sheet.add(response_chart(view, found));
  sheet.explain({"range point", {}, kScanPoint, {}, {}});
  sheet.explain({"corner operator", kOtherArm, MarkStyle{MarkShape::dot, 3.0, kSkyBlue}, {}, {}});
  sheet.explain({"at a corner", kPeakArm, MarkStyle{MarkShape::dot, 4.0, kVermilion}, {}, {}});
  sheet.explain({"threshold", kThreshold, {}, {}, {}});
  return sheet.write(path);
}

}  // namespace adit
