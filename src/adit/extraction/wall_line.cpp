#include "adit/extraction/wall_line.hpp"

#include <Eigen/LU>
#include <cmath>

namespace adit {
namespace {

constexpr double kGrazingCosine = 0.05;   // beams nearer to parallel say nothing about the line
constexpr double kAmbiguousPoints = 2.0;  // next to a cut

struct NormalEquations {
  Matrix2d information = Matrix2d::Zero();
  Vector2d gradient = Vector2d::Zero();
  double chi_square = 0.0;
  int points = 0;
};

Line start_line(const ScanPoints& points, ScanStretch s) {
  const LineFit fit = fit_line(points.moments(s.begin, s.end));
  const Vector2d chord = points.point(s.end - 1) - points.point(s.begin);
  const Vector2d along = fit.direction.dot(chord) < 0.0 ? Vector2d(-fit.direction) : fit.direction;
  Line line;
  line.orientation = std::atan2(-along.x(), along.y());  // outward: `along` turned by -90 degrees
  line.distance = unit_vector(line.orientation).dot(fit.centroid);
  return line;
}

NormalEquations accumulate(const ScanPoints& points, ScanStretch s, const Line& line, double gate) {
  NormalEquations sum;
  const Vector2d normal = unit_vector(line.orientation);
  const Vector2d tangent = perpendicular(normal);
  double aa = 0.0, ad = 0.0, dd = 0.0, ga = 0.0, gd = 0.0;
  for (std::size_t i = s.begin; i < s.end; ++i) {
    const Vector2d beam = points.beam(i);
    const double cosine = normal.dot(beam);
    // The range that the line predicts, not the noisy one: it keeps the fit unbiased.
    const double range = cosine < kGrazingCosine ? points.range(i) : line.distance / cosine;
    const double weight =
        1.0 / points.noise().across(std::max(cosine * cosine, 1e-3), range * range);
    const double error = points.range(i) * cosine - line.distance;
    const double chi_square = error * error * weight;
    if (chi_square > gate * gate) continue;
    const double along = range * tangent.dot(beam);
    aa += weight * along * along;
    ad -= weight * along;
    dd += weight;
    ga += weight * along * error;
    gd -= weight * error;
    sum.chi_square += chi_square;
    ++sum.points;
  }
  sum.information << aa, ad, ad, dd;
  sum.gradient << ga, gd;
  return sum;
}

/// The points next to a cut may belong to its other side, and their own noise decided: a few of
/// them err together by one sigma. What that does to the line, to first order, as covariance.
Matrix2d ambiguity(const ScanPoints& points, std::size_t end, const Line& line,
                   const Matrix2d& covariance) {
  const Vector2d normal = unit_vector(line.orientation);
  const Vector2d point = points.point(end);
  const double cosine = std::max(normal.dot(points.beam(end)), kGrazingCosine);
  const double sigma = std::sqrt(points.noise().across(cosine * cosine, point.squaredNorm()));
  const Vector2d jacobian(perpendicular(normal).dot(point), -1.0);
  const Vector2d shift = covariance * jacobian * (kAmbiguousPoints / sigma);
  return shift * shift.transpose();
}

}  // namespace

Vector2d meet(const Line& line, const Vector2d& beam, const Vector2d& fallback) {
  const Vector2d normal = unit_vector(line.orientation);
  const double cosine = normal.dot(beam);
  if (cosine > kGrazingCosine) return beam * (line.distance / cosine);
  return fallback + normal * (line.distance - normal.dot(fallback));
}

std::optional<Line> fit_wall_line(const ScanPoints& points, ScanStretch s, int min_points,
                                  const CutEnds& cuts, double gate) {
  if (static_cast<int>(s.size()) < min_points) return std::nullopt;
  Line line = start_line(points, s);
  const NormalEquations sum = accumulate(points, s, line, gate);
  if (sum.points < min_points || !(sum.information.determinant() > 0.0)) return std::nullopt;
  const Vector2d step = -sum.information.inverse() * sum.gradient;
  if (!step.allFinite() || std::abs(step.x()) > 0.5) return std::nullopt;
  line.orientation = wrap_angle(line.orientation + step.x());
  line.distance += step.y();
  const double freedom = std::max(1.0, sum.points - 2.0);
  const double scatter = sum.chi_square / freedom;
  const double usual = 1.0 + 2.0 * std::sqrt(2.0 / freedom);
  const Matrix2d covariance = sum.information.inverse() * (scatter > usual ? scatter : 1.0);
  line.covariance = covariance;
  if (cuts.begin) line.covariance += ambiguity(points, s.begin, line, covariance);
  if (cuts.end) line.covariance += ambiguity(points, s.end - 1, line, covariance);
  line.points = sum.points;
  line.begin = meet(line, points.beam(s.begin), points.point(s.begin));
  line.end = meet(line, points.beam(s.end - 1), points.point(s.end - 1));
  return line;
}

}  // namespace adit
