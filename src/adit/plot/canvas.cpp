#include "adit/plot/canvas.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace adit {
namespace {

constexpr double kMargin = 0.03;     // of the content's longer side, on every side
constexpr double kThinnest = 0.25;   // a view's shorter side, of its longer one
constexpr double kSmallest = 0.001;  // m, half a view's side

}  // namespace

void Canvas::extend(const Vector2d& point) {
  if (point.allFinite()) content_.extend(point);
}

void Canvas::segments(std::span<const Segment> segments, const Stroke& style) {
  PathLayer layer{{}, style};
  layer.path.points.reserve(2 * segments.size());
  for (const Segment& s : segments) {
    if (!s.is_finite()) continue;
    // Walls drawn one after the other become one line, with proper joints.
    if (layer.path.points.empty() || layer.path.points.back() != s.a) {
      layer.path.begin();
      layer.path.points.push_back(s.a);
    }
    layer.path.points.push_back(s.b);
    extend(s.a);
    extend(s.b);
  }
  layers_.emplace_back(std::move(layer));
}

void Canvas::polyline(std::span<const Vector2d> points, const Stroke& style) {
  PathLayer layer{{}, style};
  layer.path.begin();
  layer.path.points.assign(points.begin(), points.end());
  for (const Vector2d& p : points) extend(p);
  layers_.emplace_back(std::move(layer));
}

void Canvas::marks(std::span<const Vector2d> places, const MarkStyle& style) {
  MarkLayer layer{{}, style};
  for (const Vector2d& p : places) {
    if (!p.allFinite()) continue;
    layer.places.push_back(p);
    extend(p);
  }
  layers_.emplace_back(std::move(layer));
}

void Canvas::arrows(std::span<const Pose2> poses, const ArrowStyle& style) {
  ArrowLayer layer{{}, style};
  for (const Pose2& pose : poses) {
    if (!pose.is_finite()) continue;
    layer.poses.push_back(pose);
    extend(pose.translation());
  }
  layers_.emplace_back(std::move(layer));
}

void Canvas::area(std::span<const Vector2d> corners, const std::optional<Colour>& fill,
                  const std::optional<Stroke>& outline) {
  layers_.emplace_back(
      AreaLayer{std::vector<Vector2d>(corners.begin(), corners.end()), fill, outline});
}

void Canvas::ellipse(const Vector2d& center, const Matrix2d& covariance, double sigmas,
                     const std::optional<Colour>& fill, const std::optional<Stroke>& outline) {
  if (!center.allFinite() || !covariance.allFinite() || !std::isfinite(sigmas)) return;
  const Eigen::SelfAdjointEigenSolver<Matrix2d> axes(covariance);
  const Vector2d& variance = axes.eigenvalues();
  if (variance.x() < -1e-9 * std::abs(variance.y())) return;
  const Vector2d radii = sigmas * variance.cwiseMax(0.0).cwiseSqrt();
  constexpr int kCorners = 48;
  std::array<Vector2d, kCorners> corners;
  for (int i = 0; i < kCorners; ++i) {
    const Vector2d around = unit_vector(kTwoPi * i / kCorners).cwiseProduct(radii);
    corners[static_cast<std::size_t>(i)] = center + axes.eigenvectors() * around;
  }
  area(corners, fill, outline);
}

void Canvas::sector(const Vector2d& center, double radius, double from, double to,
                    const Colour& fill) {
  if (!center.allFinite() || !std::isfinite(radius) || !std::isfinite(from + to)) return;
  const double sweep = std::clamp(to - from, 0.0, kTwoPi);
  const int count = std::max(2, static_cast<int>(std::ceil(sweep / radians(3.0))));
  std::vector<Vector2d> corners{center};
  for (int i = 0; i <= count; ++i) {
    corners.emplace_back(center + radius * unit_vector(from + sweep * i / count));
  }
  area(corners, fill, std::nullopt);
}

void Canvas::label(const Vector2d& place, std::string words, const TextStyle& style,
                   double clearance) {
  if (place.allFinite()) labels_.push_back({place, std::move(words), style, clearance});
}

Box Canvas::view() const {
  const bool asked =
      view_ && !view_->is_empty() && view_->min.allFinite() && view_->max.allFinite();
  Box box = asked ? *view_ : content_;
  if (box.is_empty()) box = {Vector2d::Constant(-1.0), Vector2d::Constant(1.0)};
  double longer = box.size().maxCoeff();
  if (longer < kSmallest) {
    box = box.padded(1.0);
    longer = box.size().maxCoeff();
  }
  if (!asked) box = box.padded(kMargin * longer);
  const Vector2d lacking = (Vector2d::Constant(kThinnest * longer) - box.size()).cwiseMax(0.0);
  return {box.min - 0.5 * lacking, box.max + 0.5 * lacking};
}

double Canvas::scale_in(const PageRect& area) const {
  return area.size.cwiseQuotient(view().size()).minCoeff();
}

}  // namespace adit
