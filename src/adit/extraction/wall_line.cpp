#include "adit/extraction/wall_line.hpp"

#include <Eigen/LU>
#include <cmath>

namespace adit {
namespace {

constexpr double kGrazingCosine = 0.05;  // beams nearer to parallel say nothing about the line

struct NormalEquations {
  Matrix2d information = Matrix2d::Zero();
  Vector2d gradient = Vector2d::Zero();
  double chi_square = 0.0;
  int points = 0;
};

Line start_line(const ScanPoints& points, Stretch s) {
  const LineFit fit = fit_line(points.moments(s.begin, s.end));
  const Vector2d chord = points.point(s.end - 1) - points.point(s.begin);
  const Vector2d along = fit.direction.dot(chord) < 0.0 ? Vector2d(-fit.direction) : fit.direction;
  Line line;
  line.orientation = std::atan2(-along.x(), along.y());  // outward: `along` turned by -90 degrees
  line.distance = unit_vector(line.orientation).dot(fit.centroid);
  return line;
}

NormalEquations accumulate(const ScanPoints& points, Stretch s, const Line& line, double gate) {
  NormalEquations sum;
  const Vector2d normal = unit_vector(line.orientation);
  const Vector2d tangent = perpendicular(normal);
  for (std::size_t i = s.begin; i < s.end; ++i) {
    const Vector2d beam = points.beam(i);
    const double cosine = normal.dot(beam);
    // The range that the line predicts, not the noisy one: it keeps the fit unbiased.
    const bool grazing = cosine < kGrazingCosine;
    const double range = grazing ? points.range(i) : line.distance / cosine;
    const double variance = points.noise().across(std::max(cosine * cosine, 1e-3), range * range);
    const double error = points.range(i) * cosine - line.distance;
    if (error * error > gate * gate * variance) continue;
    const Vector2d jacobian(range * tangent.dot(beam), -1.0);
    sum.information.noalias() += jacobian * jacobian.transpose() / variance;
    sum.gradient.noalias() += jacobian * (error / variance);
    sum.chi_square += error * error / variance;
    ++sum.points;
  }
  return sum;
}

}  // namespace

Vector2d meet(const Line& line, const Vector2d& beam, const Vector2d& fallback) {
  const Vector2d normal = unit_vector(line.orientation);
  const double cosine = normal.dot(beam);
  if (cosine > kGrazingCosine) return beam * (line.distance / cosine);
  return fallback + normal * (line.distance - normal.dot(fallback));
}

std::optional<Line> fit_wall_line(const ScanPoints& points, Stretch s, int min_points,
                                  double gate) {
  if (static_cast<int>(s.size()) < min_points) return std::nullopt;
  Line line = start_line(points, s);
  constexpr double kNoGate = 1e6;
  NormalEquations sum;
  for (const double limit : {kNoGate, gate}) {
    sum = accumulate(points, s, line, limit);
    const double determinant = sum.information.determinant();
    if (sum.points < min_points || !(determinant > 0.0)) return std::nullopt;
    const Vector2d step = -sum.information.inverse() * sum.gradient;
    if (!step.allFinite() || std::abs(step.x()) > 0.5) return std::nullopt;
    line.orientation = wrap_angle(line.orientation + step.x());
    line.distance += step.y();
  }
  const double freedom = std::max(1.0, sum.points - 2.0);
  const double scatter = sum.chi_square / freedom;
  const double usual = 1.0 + 2.0 * std::sqrt(2.0 / freedom);
  line.covariance = sum.information.inverse() * (scatter > usual ? scatter : 1.0);
  line.points = sum.points;
  line.begin = meet(line, points.beam(s.begin), points.point(s.begin));
  line.end = meet(line, points.beam(s.end - 1), points.point(s.end - 1));
  return line;
}

}  // namespace adit
