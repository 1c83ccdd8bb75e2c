#include <algorithm>
#include <limits>

#include "adit/geometry/moments.hpp"
#include "adit/survey/wall_polyline.hpp"

namespace adit {
namespace {

constexpr std::size_t kLongest = 400;  // points of one piece: bounds the time of long walls
constexpr double kReferenceM = 1.0;    // m of points at the tolerance that cost as much as a piece

/// Sums over the first points, relative to one of them so that mine coordinates keep their digits.
std::vector<Moments> prefix_sums(std::span<const Vector2d> points) {
  std::vector<Moments> sums(points.size() + 1);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Vector2d p = points[i] - points[0];
    sums[i + 1] = sums[i];
    sums[i + 1].add(p.x(), p.y());
  }
  return sums;
}

bool within(std::span<const Vector2d> points, const Vector2d& origin, const LineFit& line,
            double tolerance) {
  const Vector2d normal = perpendicular(line.direction);
  const double offset = normal.dot(line.centroid + origin);
  return std::all_of(points.begin(), points.end(), [&](const Vector2d& p) {
    return std::abs(normal.dot(p) - offset) <= tolerance;
  });
}

}  // namespace

std::vector<std::size_t> split_into_lines(std::span<const Vector2d> points, double spacing_m,
                                          double tolerance_m) {
  const std::size_t n = points.size();
  if (n < 4) return {0};
  const std::vector<Moments> sums = prefix_sums(points);
  const double misfit_cost = spacing_m / (kReferenceM * tolerance_m * tolerance_m);
  constexpr double kNone = std::numeric_limits<double>::infinity();
  std::vector<double> cost(n + 1, kNone);
  std::vector<std::size_t> from(n + 1, 0);
  cost[0] = 0.0;
  for (std::size_t end = 2; end <= n; ++end) {
    for (std::size_t begin = end > kLongest ? end - kLongest : 0; begin + 2 <= end; ++begin) {
      if (cost[begin] + 1.0 >= cost[end]) continue;
      const LineFit line = fit_line(sums[end] - sums[begin]);
      const double total = cost[begin] + 1.0 + misfit_cost * line.squared_error;
      if (total >= cost[end]) continue;
      const bool short_piece = end - begin == 2;
      if (!short_piece &&
          !within(points.subspan(begin, end - begin), points[0], line, tolerance_m)) {
        continue;
      }
      cost[end] = total;
      from[end] = begin;
    }
  }
  std::vector<std::size_t> begins;
  for (std::size_t end = n; end > 0; end = from[end]) begins.push_back(from[end]);
  std::reverse(begins.begin(), begins.end());
  return begins;
}

}  // namespace adit
