#include "adit/features/features.hpp"

#include <algorithm>

namespace adit {
namespace {

double azimuth_of(const Vector2d& p) { return std::atan2(p.y(), p.x()); }

Matrix2d rotation_of(const RigidTransform& t) {
  Matrix2d r;
  r << t.axis_x.x(), -t.axis_x.y(), t.axis_x.y(), t.axis_x.x();
  return r;
}

Line carried(const Line& line, const RigidTransform& t, double turn) {
  Line out = line;
  out.begin = t.point(line.begin);
  out.end = t.point(line.end);
  out.orientation = wrap_angle(line.orientation + turn);
  const Vector2d normal = unit_vector(out.orientation);
  out.distance = line.distance + normal.dot(t.origin);
  // d' = d + n(alpha') . t, so the new distance also moves with the orientation.
  Matrix2d jacobian;
  jacobian << 1.0, 0.0, perpendicular(normal).dot(t.origin), 1.0;
  out.covariance = jacobian * line.covariance * jacobian.transpose();
  return out;
}

Corner carried(const Corner& corner, const RigidTransform& t, const Matrix2d& rotation,
               double turn) {
  Corner out = corner;
  out.position = t.point(corner.position);
  out.covariance = rotation * corner.covariance * rotation.transpose();
  if (corner.bisector) out.bisector = wrap_angle(*corner.bisector + turn);
  return out;
}

}  // namespace

void sort_counter_clockwise(FeatureList& features) {
  features.order.clear();
  for (std::size_t i = 0; i < features.corners.size(); ++i) {
    features.order.push_back(
        {FeatureKind::corner, static_cast<int>(i), azimuth_of(features.corners[i].position)});
  }
  for (std::size_t i = 0; i < features.lines.size(); ++i) {
    const Line& line = features.lines[i];
    const Vector2d middle = line.begin.normalized() + line.end.normalized();
    features.order.push_back({FeatureKind::line, static_cast<int>(i), azimuth_of(middle)});
  }
  std::sort(features.order.begin(), features.order.end(),
            [](const FeatureRef& a, const FeatureRef& b) {
              if (a.azimuth != b.azimuth) return a.azimuth < b.azimuth;
              if (a.kind != b.kind) return a.kind < b.kind;
              return a.index < b.index;
            });
}

Line transform(const Line& line, const Pose2& b_from_a) {
  return carried(line, RigidTransform(b_from_a), b_from_a.theta);
}

Corner transform(const Corner& corner, const Pose2& b_from_a) {
  const RigidTransform t(b_from_a);
  return carried(corner, t, rotation_of(t), b_from_a.theta);
}

void transform(const FeatureList& features, const Pose2& b_from_a, FeatureList& out) {
  const RigidTransform t(b_from_a);
  const Matrix2d rotation = rotation_of(t);
  out.clear();
  for (const Corner& corner : features.corners) {
    out.corners.push_back(carried(corner, t, rotation, b_from_a.theta));
  }
  for (const Line& line : features.lines) out.lines.push_back(carried(line, t, b_from_a.theta));
  sort_counter_clockwise(out);
}

}  // namespace adit
