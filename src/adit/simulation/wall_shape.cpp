#include "adit/simulation/wall_shape.hpp"

#include <algorithm>
#include <cmath>

namespace adit {
namespace {

/// Neighbours of a point in a closed line, or in the inside of an open one.
struct Neighbours {
  Vector2d before;
  Vector2d after;
};

Neighbours neighbours(const Polyline& line, std::size_t i) {
  const std::size_t n = line.points.size();
  return {line.points[(i + n - 1) % n], line.points[(i + 1) % n]};
}

/// Replaces one corner by an arc that touches both sides.
void append_arc(const Vector2d& before, const Vector2d& corner, const Vector2d& after,
                double radius, double spacing, std::vector<Vector2d>& out) {
  const Vector2d in = (corner - before).normalized();
  const Vector2d leaving = (after - corner).normalized();
  const double turn = std::atan2(cross(in, leaving), in.dot(leaving));
  const double half_tangent = std::tan(0.5 * std::abs(turn));
  // Each side lends at most 45 % of its length, so that two arcs on one side never meet.
  const double room = 0.45 * std::min((corner - before).norm(), (after - corner).norm());
  const double touch = std::min(radius * half_tangent, room);
  if (touch < 1e-6 || std::abs(turn) > 3.1) {
    out.push_back(corner);
    return;
  }
  const double side = turn > 0.0 ? 1.0 : -1.0;
  const double used_radius = touch / half_tangent;
  const Vector2d start = corner - touch * in;
  const Vector2d center = start + side * used_radius * perpendicular(in);
  const int pieces = std::max(2, static_cast<int>(used_radius * std::abs(turn) / spacing) + 1);
  const double first = std::atan2(start.y() - center.y(), start.x() - center.x());
  for (int i = 0; i <= pieces; ++i) {
    out.emplace_back(center + used_radius * unit_vector(first + turn * i / pieces));
  }
}

/// Stationary Gaussian noise round a closed line of `count` points, sigma 1: white noise smoothed
/// by a Gaussian, whose correlation is Gaussian too and falls to 1/e at `correlation` points.
std::vector<double> correlated_noise(std::size_t count, double correlation, Random& random) {
  const double width = std::max(0.5 * correlation, 1e-3);
  const int reach = std::min(static_cast<int>(4.0 * width) + 1, static_cast<int>(count) / 2);
  std::vector<double> kernel;
  double power = 0.0;
  for (int k = -reach; k <= reach; ++k) {
    kernel.push_back(std::exp(-0.5 * k * k / (width * width)));
    power += kernel.back() * kernel.back();
  }
  std::vector<double> white(count);
  for (double& value : white) value = random.normal();
  std::vector<double> smooth(count, 0.0);
  for (std::size_t i = 0; i < count; ++i) {
    for (std::size_t k = 0; k < kernel.size(); ++k) {
      const std::size_t from = (i + k + count - static_cast<std::size_t>(reach)) % count;
      smooth[i] += kernel[k] * white[from];
    }
    smooth[i] /= std::sqrt(power);
  }
  return smooth;
}

double saw_tooth(double along, double spacing) {
  return along / spacing - std::floor(along / spacing) - 0.5;
}

}  // namespace

Polyline round_corners(const Polyline& line, double radius, double spacing) {
  const std::size_t n = line.points.size();
  if (n < 3 || radius <= 0.0) return line;
  Polyline rounded{{}, line.closed};
  for (std::size_t i = 0; i < n; ++i) {
    if (!line.closed && (i == 0 || i + 1 == n)) {
      rounded.points.push_back(line.points[i]);
      continue;
    }
    const auto [before, after] = neighbours(line, i);
    append_arc(before, line.points[i], after, radius, spacing, rounded.points);
  }
  return rounded;
}

Polyline resample(const Polyline& line, double spacing) {
  const std::size_t n = line.points.size();
  const std::size_t sides = line.closed ? n : n - 1;
  if (n < 2) return line;
  std::vector<double> reached{0.0};
  for (std::size_t i = 0; i < sides; ++i) {
    reached.push_back(reached.back() + (line.points[(i + 1) % n] - line.points[i]).norm());
  }
  const int pieces =
      std::max(line.closed ? 3 : 1, static_cast<int>(std::lround(reached.back() / spacing)));
  Polyline even{{}, line.closed};
  std::size_t side = 0;
  for (int i = 0; i < (line.closed ? pieces : pieces + 1); ++i) {
    const double at = reached.back() * i / pieces;
    while (side + 1 < sides && reached[side + 1] < at) ++side;
    const double length = reached[side + 1] - reached[side];
    const double fraction = length > 0.0 ? (at - reached[side]) / length : 0.0;
    const Vector2d& from = line.points[side];
    even.points.emplace_back(from + fraction * (line.points[(side + 1) % n] - from));
  }
  return even;
}

Polyline roughen(const Polyline& outline, const RoughnessOptions& options, Random& random) {
  const Polyline smooth =
      resample(round_corners(outline, options.corner_radius_m, options.point_spacing_m),
               options.point_spacing_m);
  const std::size_t n = smooth.points.size();
  const std::vector<double> fine =
      correlated_noise(n, options.correlation_m / options.point_spacing_m, random);
  const std::vector<double> waves =
      correlated_noise(n, options.wave_correlation_m / options.point_spacing_m, random);
  const double first_round = random.uniform(0.0, options.rib_spacing_m);
  Polyline rough{{}, outline.closed};
  for (std::size_t i = 0; i < n; ++i) {
    const auto [before, after] = neighbours(smooth, i);
    const Vector2d across = perpendicular((after - before).normalized());
    const double along = first_round + static_cast<double>(i) * options.point_spacing_m;
    rough.points.emplace_back(smooth.points[i] +
                              (options.rms_m * fine[i] + options.wave_rms_m * waves[i] +
                               options.rib_depth_m * saw_tooth(along, options.rib_spacing_m)) *
                                  across);
  }
  return rough;
}

std::vector<Pose2> drive_through(std::span<const Vector2d> way_points, double radius, double step) {
  const Polyline way{{way_points.begin(), way_points.end()}, false};
  if (way.points.size() < 2) return {};
  const Polyline even = resample(round_corners(way, radius, 0.1), step);
  std::vector<Pose2> path;
  for (std::size_t i = 0; i < even.points.size(); ++i) {
    const Vector2d& before = even.points[i > 0 ? i - 1 : i];
    const Vector2d& after = even.points[i + 1 < even.points.size() ? i + 1 : i];
    const Vector2d ahead = after - before;
    path.push_back({even.points[i].x(), even.points[i].y(), std::atan2(ahead.y(), ahead.x())});
  }
  return path;
}

}  // namespace adit
