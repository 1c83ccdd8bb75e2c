#include "adit/places/corner_index.hpp"

#include <algorithm>
#include <cmath>

namespace adit {
namespace {

double direction_of(const Vector2d& along) { return std::atan2(along.y(), along.x()); }

/// How a wall leaves a point that its line is on.
struct Leaving {
  Vector2d along = Vector2d::UnitX();
  double gap_m = 0.0;
};

/// None if the wall begins too far off or goes on beyond the point.
std::optional<Leaving> leaving(const Segment& wall, const Vector2d& point, double longest_gap_m) {
  const double length = wall.length();
  const Vector2d along = (wall.b - wall.a) / length;
  const double way = along.dot(point - wall.a);
  const bool is_at_start = way < 0.5 * length;
  const double beyond = is_at_start ? -way : way - length;
  if (!(beyond <= longest_gap_m && beyond >= -std::min(0.3, 0.2 * length))) return std::nullopt;
  return Leaving{is_at_start ? along : Vector2d(-along), std::max(0.0, beyond)};
}

Sector sector_at(const Vector2d& at, const Vector2d& along, double opening) {
  return {static_cast<float>(at.x()), static_cast<float>(at.y()), static_cast<float>(along.x()),
          static_cast<float>(along.y()), static_cast<float>(opening)};
}

/// Calls `each(meet)` for the corners of a plan, in the order of its walls.
template <class Each>
void for_each_corner(const LineMap& map, const CornerLimits& limits, const Each& each) {
  std::vector<int> near;
  for (int w = 0; w < static_cast<int>(map.walls().size()); ++w) {
    const Segment& wall = map.walls()[static_cast<std::size_t>(w)].segment;
    if (wall.length() < limits.least_arm_m) continue;
    near.clear();
    map.near(wall.a, 2.0 * limits.longest_gap_m, near);
    map.near(wall.b, 2.0 * limits.longest_gap_m, near);
    std::sort(near.begin(), near.end());
    near.erase(std::unique(near.begin(), near.end()), near.end());
    for (const int other : near) {
      if (other <= w) continue;
      const Segment& segment = map.walls()[static_cast<std::size_t>(other)].segment;
      if (const auto met = corner_of(wall, segment, limits)) each(*met);
    }
  }
}

}  // namespace

std::optional<Meet> corner_of(const Segment& a, const Segment& b, const CornerLimits& limits) {
  const Vector2d along_a = a.b - a.a;
  const Vector2d along_b = b.b - b.a;
  const double length_a = along_a.norm();
  const double length_b = along_b.norm();
  if (!(std::min(length_a, length_b) >= std::max(1e-3, limits.least_arm_m))) return std::nullopt;
  const double turn = cross(along_a, along_b) / (length_a * length_b);
  if (!(std::abs(turn) >= std::max(1e-3, std::sin(limits.least_turn_rad)))) return std::nullopt;
  const double way = cross(b.a - a.a, along_b) / (turn * length_b);
  const Vector2d point = a.a + way / length_a * along_a;
  const auto away_a = leaving(a, point, limits.longest_gap_m);
  const auto away_b = leaving(b, point, limits.longest_gap_m);
  if (!away_a || !away_b) return std::nullopt;
  return Meet{point, away_a->along, away_b->along, std::max(away_a->gap_m, away_b->gap_m)};
}

std::size_t CornerIndex::width_of(double opening_rad) {
  constexpr double kWidth = kTwoPi / static_cast<double>(kWidths);
  const double last = static_cast<double>(kWidths - 1);
  return static_cast<std::size_t>(std::clamp(std::floor(opening_rad / kWidth), 0.0, last));
}

std::size_t CornerIndex::gap_of(double gap_m) {
  const double last = static_cast<double>(kGaps - 1);
  return static_cast<std::size_t>(std::clamp(std::floor(gap_m), 0.0, last));
}

CornerIndex::CornerIndex(const LineMap& map, const Vector2d& origin, const CornerLimits& limits) {
  // Twice the same: what is counted first has its place when it is put there.
  const auto for_each = [&](const auto& take) {
    for_each_corner(map, limits, [&](const Meet& met) {
      const double a = direction_of(met.along_a);
      const double b = direction_of(met.along_b);
      const Vector2d at = met.point - origin;
      take(gap_of(met.gap_m), sector_at(at, met.along_a, turned(a, b)));
      take(gap_of(met.gap_m), sector_at(at, met.along_b, turned(b, a)));
    });
  };
  const auto class_of = [](std::size_t gap, const Sector& sector) {
    return width_of(static_cast<double>(sector.opening)) * kGaps + gap;
  };
  begins_.assign(kWidths * kGaps + 1, 0);
  for_each([&](std::size_t gap, const Sector& sector) { ++begins_[class_of(gap, sector) + 1]; });
  for (std::size_t c = 0; c + 1 < begins_.size(); ++c) begins_[c + 1] += begins_[c];
  sectors_.resize(begins_.back());
  std::vector<std::size_t> next(begins_.begin(), begins_.end() - 1);
  for_each([&](std::size_t gap, const Sector& sector) {
    sectors_[next[class_of(gap, sector)]++] = sector;
  });
}

std::size_t CornerIndex::memory() const {
  return sectors_.capacity() * sizeof(Sector) + begins_.capacity() * sizeof(std::size_t);
}

}  // namespace adit
