#include "adit/visibility/visibility.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "adit/geometry/angle.hpp"
#include "adit/visibility/bearing_key.hpp"

namespace adit {
namespace {

constexpr double kEpsilon = std::numeric_limits<double>::epsilon();

// Keys that differ by less are one bearing: rounding leaves about 1e-15.
constexpr double kSameKey = 1e-12;

// A wall whose line passes nearer to the observer than this is seen edge-on (m).
double edge_on_distance(const Vector2d& observer) {
  return std::max(1e-9, 4.0 * kEpsilon * observer.cwiseAbs().maxCoeff());
}

/// Lays the wall counter-clockwise around the observer; false when it is seen edge-on.
bool orient(const Wall& wall, const Vector2d& observer, double edge_on, SweptWall& out) {
  const Vector2d a = wall.segment.a - observer;
  const Vector2d b = wall.segment.b - observer;
  const double turn = cross(a, b);
  if (!(turn * turn > edge_on * edge_on * (b - a).squaredNorm())) return false;
  const bool forward = turn > 0.0;
  out.begin = forward ? a : b;
  out.end = forward ? b : a;
  out.begin_vertex = forward ? wall.vertex_a : wall.vertex_b;
  out.end_vertex = forward ? wall.vertex_b : wall.vertex_a;
  return true;
}

void set_inverse_range(SweptWall& wall) {
  const double turn = cross(wall.begin, wall.end);
  wall.inverse_range = (wall.end - wall.begin) / turn;
  wall.rounding =
      1e-12 + 16.0 * kEpsilon * std::sqrt(wall.begin.squaredNorm() * wall.end.squaredNorm()) / turn;
}

/// Cuts the wall to the disk of the range; false when nothing is left.
bool clip(SweptWall& wall, double max_range) {
  const double range_squared = max_range * max_range;
  const bool begin_inside = wall.begin.squaredNorm() <= range_squared;
  const bool end_inside = wall.end.squaredNorm() <= range_squared;
  if (begin_inside && end_inside) return true;
  const Vector2d along = wall.end - wall.begin;
  const double length = along.norm();
  const Vector2d unit = along / length;
  const double offset = cross(wall.begin, unit);
  const double half_chord_squared = range_squared - offset * offset;
  if (!(half_chord_squared > 0.0)) return false;
  const double half_chord = std::sqrt(half_chord_squared);
  const double middle = -wall.begin.dot(unit);
  if (middle - half_chord >= length || middle + half_chord <= 0.0) return false;
  const Vector2d begin = wall.begin;
  if (!begin_inside) {
    wall.begin = begin + unit * (middle - half_chord);
    wall.begin_vertex = -1;
  }
  if (!end_inside) {
    wall.end = begin + unit * (middle + half_chord);
    wall.end_vertex = -1;
  }
  return true;
}

/// Sets the keys; false when the wall subtends nothing.
bool set_keys(SweptWall& wall) {
  wall.begin_key = bearing_key(wall.begin);
  wall.end_key = bearing_key(wall.end);
  // The bearing pi is the first one for a wall that begins there, the last for one that ends there.
  if (2.0 - std::abs(wall.begin_key) < kSameKey) wall.begin_key = -2.0;
  if (2.0 - std::abs(wall.end_key) < kSameKey) wall.end_key = 2.0;
  // No wall subtends more than pi (a width of 2); a hair that rounding turned round seems to.
  const double width = wall.end_key - wall.begin_key;
  return width > 0.0 ? width < 3.0 : width < -1.0;
}

double squared_distance(const SweptWall& wall) {
  return nearest_point({wall.begin, wall.end}, Vector2d::Zero()).squaredNorm();
}

double farthest_in(const Box& box, const Vector2d& observer) {
  return (observer - box.min).cwiseAbs().cwiseMax((observer - box.max).cwiseAbs()).norm();
}

/// The point of the wall along a direction that it spans.
Vector2d point_along(const SweptWall& wall, double key) {
  const Vector2d direction = key_direction(key);
  const Vector2d along = wall.end - wall.begin;
  const double share = cross(wall.begin, direction) / cross(direction, along);
  return wall.begin + along * std::clamp(share, 0.0, 1.0);
}

VisibleInterval interval_of(const SweptWall& wall, double begin_key, double end_key) {
  VisibleInterval out;
  out.wall = wall.wall;
  if (std::abs(begin_key - wall.begin_key) < kSameKey) {
    out.begin = wall.begin;
    out.begin_vertex = wall.begin_vertex;
    out.begin_kind = wall.begin_vertex >= 0 ? Boundary::vertex : Boundary::range_limit;
  } else {
    out.begin = point_along(wall, begin_key);
    out.begin_kind = Boundary::occluded;
  }
  if (std::abs(end_key - wall.end_key) < kSameKey) {
    out.end = wall.end;
    out.end_vertex = wall.end_vertex;
    out.end_kind = wall.end_vertex >= 0 ? Boundary::vertex : Boundary::range_limit;
  } else {
    out.end = point_along(wall, end_key);
    out.end_kind = Boundary::occluded;
  }
  return out;
}

}  // namespace

void Visibility::sweep(const LineMap& map, const Vector2d& observer, double max_range) {
  envelope_.clear();
  if (!map.empty() && observer.allFinite() && max_range > 0.0) add_rings(map, observer, max_range);
  collect_intervals();
}

// From near to far: what near walls hide is dropped at little cost, and once they close the view
// the far ones are not even looked up.
void Visibility::add_rings(const LineMap& map, const Vector2d& observer, double max_range) {
  constexpr double kFirstRadius = 1.0 / 32.0;  // of the range
  constexpr double kGrowth = 4.0;
  constexpr std::size_t kWorthARing = 24;
  const double farthest = std::min(max_range, farthest_in(map.bounds(), observer));
  double radius = kFirstRadius * farthest;
  find_near(map, observer, radius);
  while (near_.size() < kWorthARing && radius < farthest) {
    radius = std::min(farthest, 2.0 * radius);
    find_near(map, observer, radius);
  }
  double done = -1.0;
  while (true) {
    stage_ring(map, observer, Ring{done, radius}, max_range);
    envelope_.merge_staged();
    if (near_.size() == map.walls().size()) return;
    envelope_.measure_reach();
    done = radius;
    radius = std::min({farthest, envelope_.reach(), kGrowth * radius});
    if (radius <= done) return;
    find_near(map, observer, radius);
  }
}

void Visibility::find_near(const LineMap& map, const Vector2d& observer, double radius) {
  constexpr double kRoundingMargin = 1.0 + 1e-9;
  near_.clear();
  map.near(observer, radius * kRoundingMargin, near_);
}

void Visibility::stage_ring(const LineMap& map, const Vector2d& observer, Ring ring,
                            double max_range) {
  const double edge_on = edge_on_distance(observer);
  const bool check_hidden = !envelope_.pieces().empty();
  SweptWall wall;
  for (const int index : near_) {
    wall.wall = index;
    if (!orient(map.walls()[static_cast<std::size_t>(index)], observer, edge_on, wall)) continue;
    const double squared = squared_distance(wall);
    const bool in_ring =
        squared > ring.inner * std::abs(ring.inner) && squared <= ring.outer * ring.outer;
    if (!in_ring || !set_keys(wall)) continue;
    if (check_hidden && envelope_.hides(wall, squared)) continue;
    set_inverse_range(wall);
    if (clip(wall, max_range) && set_keys(wall)) envelope_.stage(wall);
  }
}

void Visibility::collect_intervals() {
  intervals_.clear();
  inverse_ranges_.clear();
  turns_.clear();
  std::span<const Envelope::Piece> pieces = envelope_.pieces();
  if (pieces.empty()) return;
  double last_end = pieces.back().end;
  const bool spans_pi = pieces.size() > 1 && pieces.front().begin == -2.0 && last_end == 2.0 &&
                        pieces.front().wall == pieces.back().wall;
  if (spans_pi) {
    last_end = pieces.front().end;
    pieces = pieces.subspan(1);
  }
  for (const Envelope::Piece& piece : pieces) {
    const bool is_last = &piece == &pieces.back();
    if (!(is_last && spans_pi) && piece.end - piece.begin < kSameKey) continue;
    const SweptWall& wall = envelope_.wall(piece.wall);
    intervals_.push_back(interval_of(wall, piece.begin, is_last ? last_end : piece.end));
    inverse_ranges_.push_back(wall.inverse_range);
    const VisibleInterval& seen = intervals_.back();
    const double begin = std::atan2(seen.begin.y(), seen.begin.x());
    const double end = std::atan2(seen.end.y(), seen.end.x());
    turns_.push_back({begin, end < begin ? end + kTwoPi : end});  // it spans the bearing pi
  }
}

}  // namespace adit
