#include "adit/plot/figure_parts.hpp"

#include <algorithm>
#include <cmath>

#include "adit/plot/figures.hpp"
#include "adit/plot/painter.hpp"

namespace adit {
namespace {

bool is_kept(const std::vector<char>& keep, std::size_t i) {
  return i >= keep.size() || keep[i] != 0;
}

}  // namespace

Box box_around(std::span<const Segment> plan) {
  Box box;
  for (const Segment& s : plan) {
    if (s.is_finite()) box.extend(box_of(s));
  }
  return box;
}

Stroke wall_stroke(std::span<const Segment> plan, const Box& view, const Colour& colour) {
  const auto count = std::count_if(plan.begin(), plan.end(), [&](const Segment& s) {
    return s.is_finite() && (view.is_empty() || view.overlaps(box_of(s)));
  });
  const double crowding =
      std::sqrt(static_cast<double>(std::max<std::ptrdiff_t>(count, 1)) / 300.0);
  return {colour, std::clamp(0.9 / crowding, 0.25, 0.9)};
}

Box focused_view(std::span<const Segment> plan, const Box& focus) {
  constexpr double kShare = 0.4;   // of the plan's longer side
  constexpr double kAround = 0.2;  // of the focus' longer side
  const Box whole = box_around(plan);
  Box all = whole;
  all.extend(focus);
  if (all.is_empty()) return all;
  const double longer = all.size().maxCoeff();
  const double focused = focus.size().maxCoeff();
  if (focus.is_empty() || whole.is_empty() || focused > kShare * longer) {
    return all.padded(0.03 * longer);
  }
  return focus.padded(std::max(2.0, kAround * focused));
}

void add_features(Canvas& canvas, const FeatureList& features, const Pose2& map_from_features,
                  const FeatureStyle& style, const FeatureSelection& keep) {
  const RigidTransform carry_to_map(map_from_features);
  for (std::size_t i = 0; i < features.lines.size(); ++i) {
    if (!is_kept(keep.lines, i)) continue;
    const Line& line = features.lines[i];
    const std::vector<Vector2d> ends{carry_to_map.point(line.begin), carry_to_map.point(line.end)};
    canvas.polyline(ends, {style.colour, style.line_width});
  }
  std::vector<Vector2d> open;
  std::vector<Vector2d> closed;
  std::vector<Pose2> bisectors;
  for (std::size_t i = 0; i < features.corners.size(); ++i) {
    if (!is_kept(keep.corners, i)) continue;
    const Corner& corner = features.corners[i];
    const Vector2d at = carry_to_map.point(corner.position);
    (corner.occluding ? open : closed).push_back(at);
    if (corner.bisector) {
      bisectors.push_back({at.x(), at.y(), map_from_features.theta + *corner.bisector});
    }
  }
  if (style.bisectors) {
    canvas.arrows(bisectors, {ArrowHead::none, 2.0 * style.corner_size, 0.7, style.colour});
  }
  canvas.marks(closed, {MarkShape::dot, style.corner_size, style.colour});
  canvas.marks(open, {MarkShape::ring, style.corner_size + 0.6, style.colour});
}

Vector2d place_of(const FeatureList& features, FeatureKind kind, int index) {
  const auto i = static_cast<std::size_t>(index);
  if (kind == FeatureKind::corner) return features.corners[i].position;
  return 0.5 * (features.lines[i].begin + features.lines[i].end);
}

void explain_features(Sheet& sheet, const FeatureStyle& style, const std::string& of) {
  LegendEntry line;
  line.text = of + "line";
  line.line = Stroke{style.colour, style.line_width};
  sheet.explain(line);
  LegendEntry corner;
  corner.text = "corner";
  corner.mark = MarkStyle{MarkShape::dot, style.corner_size, style.colour};
  sheet.explain(corner);
  LegendEntry occluding;
  occluding.text = "occluding corner";
  occluding.mark = MarkStyle{MarkShape::ring, style.corner_size + 0.6, style.colour};
  sheet.explain(occluding);
}

Box box_around(const FeatureList& features, const Pose2& map_from_features) {
  const RigidTransform carry_to_map(map_from_features);
  Box box;
  const auto extend = [&](const Vector2d& p) {
    if (p.allFinite()) box.extend(carry_to_map.point(p));
  };
  for (const Line& line : features.lines) {
    extend(line.begin);
    extend(line.end);
  }
  for (const Corner& corner : features.corners) extend(corner.position);
  return box;
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

std::vector<Vector2d> returns_of(const LaserScan& scan, const Pose2& map_from_laser) {
  const RigidTransform carry_to_map(map_from_laser);
  std::vector<Vector2d> points;
  for (std::size_t i = 0; i < scan.ranges.size(); ++i) {
    if (!scan.has_return(i)) continue;
    points.push_back(carry_to_map.point(scan.ranges[i] * unit_vector(scan.bearing(i))));
  }
  return points;
}

MarkStyle range_point_style(std::size_t count) {
  return {MarkShape::dot, count > 1500 ? 1.1 : 1.5, kScanColour};
}

std::vector<Vector2d> translations(std::span<const Pose2> poses) {
  std::vector<Vector2d> places;
  places.reserve(poses.size());
  for (const Pose2& pose : poses) places.push_back(pose.translation());
  return places;
}

Result<void> check_picture_name(const std::string& path) {
  return picture_format(path).map([](PictureFormat) {});
}

}  // namespace adit
