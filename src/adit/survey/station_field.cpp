#include "adit/survey/station_field.hpp"

#include <algorithm>
#include <cmath>
#include <map>

namespace adit {
namespace {

constexpr double kCellsOfBlur = 2.0;  // cells in one sigma of the blur
constexpr double kReachOfBlur = 2.5;  // sigmas at which the blur ends
constexpr double kLikeSurface = 0.7;  // cosine of normals that are gathered

}  // namespace

std::vector<StationPoint> thin_points(std::span<const StationPoint> points, double spacing_m) {
  struct Sum {
    Vector2d point = Vector2d::Zero();
    Vector2d normal = Vector2d::Zero();
    double count = 0.0;
  };
  std::map<std::pair<long, long>, std::vector<Sum>> squares;
  for (const StationPoint& p : points) {
    auto& sums =
        squares[{std::lround(p.point.x() / spacing_m), std::lround(p.point.y() / spacing_m)}];
    auto like = std::find_if(sums.begin(), sums.end(), [&](const Sum& s) {
      return s.normal.dot(p.normal) > kLikeSurface * s.normal.norm();
    });
    if (like == sums.end()) like = sums.insert(sums.end(), Sum{});
    like->point += p.point;
    like->normal += p.normal;
    like->count += 1.0;
  }
  std::vector<StationPoint> thinned;
  for (const auto& [square, sums] : squares) {
    for (const Sum& s : sums) thinned.push_back({s.point / s.count, s.normal.normalized()});
  }
  return thinned;
}

StationField::StationField(std::span<const StationPoint> points, double blur_m)
    : cells_(blur_m / kCellsOfBlur) {
  const double reach = kReachOfBlur * blur_m;
  const double cell = cells_.cell_m();
  for (const StationPoint& p : points) {
    const GridCell low = cells_.cell_at(p.point.array() - reach);
    const GridCell high = cells_.cell_at(p.point.array() + reach);
    for (std::int32_t y = low.y; y <= high.y; ++y) {
      for (std::int32_t x = low.x; x <= high.x; ++x) {
        const Vector2d d = Vector2d((x + 0.5) * cell, (y + 0.5) * cell) - p.point;
        const auto nearness =
            static_cast<float>(std::exp(-0.5 * d.squaredNorm() / (blur_m * blur_m)));
        Cell& at = cells_.at({x, y});
        if (nearness <= at.nearness) continue;
        at = {nearness, static_cast<float>(p.normal.x()), static_cast<float>(p.normal.y())};
      }
    }
  }
}

double StationField::mean_agreement(std::span<const StationPoint> points,
                                    const Pose2& field_from_points) {
  const RigidTransform carry(field_from_points);
  double sum = 0.0;
  for (const StationPoint& p : points) {
    sum += agreement(carry.point(p.point), carry.direction(p.normal));
  }
  return points.empty() ? 0.0 : sum / static_cast<double>(points.size());
}

}  // namespace adit
