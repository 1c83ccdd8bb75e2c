#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "adit/map/line_map.hpp"
#include "support/draws.hpp"

// Ray casting by definition: the oracle for everything that says what a position sees.
namespace adit::testing {

inline constexpr double kInfinity = std::numeric_limits<double>::infinity();

inline double bearing_of(const Vector2d& v) { return std::atan2(v.y(), v.x()); }

/// The map with the default cleaning.
inline LineMap map_of(const std::vector<Segment>& segments) { return LineMap::build(segments); }

/// The map with cleaning that depends as little as possible on how the world is turned.
inline LineMap barely_cleaned(const std::vector<Segment>& segments) {
  LineMapOptions options;
  options.snap_m = 1e-9;
  options.merge_offset_m = 1e-9;
  return LineMap::build(segments, options);
}

/// Whether the wall's line passes through the observer: such a wall subtends nothing.
inline bool is_edge_on(const Segment& wall, const Vector2d& observer) {
  return std::abs(cross(wall.a - observer, wall.b - observer)) <= 1e-9 * wall.length();
}

/// Range to the wall along a direction, or infinity: the definition, without any cleverness.
inline double cast_at(const Segment& wall, const Vector2d& observer, const Vector2d& direction) {
  const Vector2d along = wall.b - wall.a;
  const Vector2d to_a = wall.a - observer;
  const double turn = cross(direction, along);
  if (turn == 0.0) return kInfinity;
  const double range = cross(to_a, along) / turn;
  const double share = cross(to_a, direction) / turn;
  const bool hit = range > 0.0 && share >= 0.0 && share <= 1.0 && !is_edge_on(wall, observer);
  return hit ? range : kInfinity;
}

/// Range to the nearest wall along a bearing (rad, map axes), or infinity beyond the maximum range.
inline double cast(const LineMap& map, const Vector2d& observer, double bearing, double max_range) {
  const Vector2d direction = unit_vector(bearing);
  double nearest = kInfinity;
  for (const Wall& wall : map.walls()) {
    nearest = std::min(nearest, cast_at(wall.segment, observer, direction));
  }
  return nearest <= max_range ? nearest : kInfinity;
}

/// Equal up to a tolerance, absolute below one metre and relative above; infinities only to each
/// other.
inline bool agree(double a, double b, double tolerance) {
  if (std::isinf(a) || std::isinf(b)) return a == b;
  return std::abs(a - b) <= tolerance * (1.0 + std::abs(b));
}

/// Whether a range is right for a bearing. At a jump of the view either side of it is right.
inline ::testing::AssertionResult is_right(double range, const LineMap& map,
                                           const Vector2d& observer, double bearing,
                                           double max_range) {
  constexpr double kNudge = 1e-10;
  const double here = cast(map, observer, bearing, max_range);
  if (agree(range, here, 1e-9)) return ::testing::AssertionSuccess();
  const double beyond = cast(map, observer, bearing, kInfinity);
  if (agree(beyond, max_range, 1e-9) && (std::isinf(range) || agree(range, max_range, 1e-9))) {
    return ::testing::AssertionSuccess();
  }
  const double before = cast(map, observer, bearing - kNudge, max_range);
  const double after = cast(map, observer, bearing + kNudge, max_range);
  const bool at_jump = !agree(before, after, 1e-5) || !agree(before, here, 1e-5);
  if (at_jump && (agree(range, before, 1e-5) || agree(range, after, 1e-5))) {
    return ::testing::AssertionSuccess();
  }
  return ::testing::AssertionFailure()
         << "range " << range << " at bearing " << bearing << ", casting gives " << here << " ("
         << before << ", " << after << " beside it)";
}

/// A map and where it is seen from.
struct Sight {
  LineMap map;
  Vector2d observer = Vector2d::Zero();
  double max_range = 0.0;
};

/// Segments between points of a small grid: shared ends, T-junctions, crossings, collinear walls.
inline std::vector<Segment> grid_segments(std::mt19937_64& random, int count, int size) {
  std::uniform_int_distribution<int> at(0, size);
  std::vector<Segment> segments;
  for (int i = 0; i < count; ++i) {
    const Vector2d a = test::drawn<2>([&] { return at(random); });
    const Vector2d b = test::drawn<2>([&] { return at(random); });
    segments.push_back({a, b});
  }
  return segments;
}

}  // namespace adit::testing
