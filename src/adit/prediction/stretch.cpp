#include "adit/prediction/stretch.hpp"

#include <algorithm>
#include <cmath>

namespace adit {
namespace {

// Relative difference of directions or ranges that is rounding.
constexpr double kRounding = 1e-9;

bool share_vertex(const VisibleInterval& before, const VisibleInterval& after) {
  return before.end_vertex >= 0 && before.end_vertex == after.begin_vertex;
}

bool same_direction(const Vector2d& a, const Vector2d& b) {
  return a.dot(b) > 0.0 && std::abs(cross(a, b)) <= kRounding * a.dot(b);
}

// Straight on: both far ends lie within the tolerance of the line through the other piece, so that
// a short piece cannot point a long one astray.
bool goes_straight(const Vector2d& begin, const Vector2d& vertex, const Vector2d& end,
                   double straight_m) {
  const Vector2d before = vertex - begin;
  const Vector2d after = end - vertex;
  const double turn = std::abs(cross(before, after));
  return before.dot(after) > 0.0 &&
         turn <= straight_m * std::sqrt(std::min(before.squaredNorm(), after.squaredNorm()));
}

// Looks at two neighbours only, so that it does not matter where a walk around the view started.
bool continues(const VisibleInterval& before, const VisibleInterval& after, double straight_m) {
  return share_vertex(before, after) &&
         goes_straight(before.begin, after.begin, after.end, straight_m);
}

StretchEnd end_of(const Vector2d& vertex, Boundary kind, bool joined, const Vector2d& neighbour) {
  if (kind != Boundary::vertex) return StretchEnd::other;
  if (joined) return StretchEnd::joined;
  const bool hidden_by_neighbour =
      same_direction(vertex, neighbour) &&
      neighbour.squaredNorm() <= vertex.squaredNorm() * (1.0 + kRounding);
  return hidden_by_neighbour ? StretchEnd::other : StretchEnd::drop;
}

}  // namespace

std::size_t first_stretch(std::span<const VisibleInterval> intervals, double straight_m) {
  for (std::size_t i = 0; i < intervals.size(); ++i) {
    const VisibleInterval& before = intervals[i > 0 ? i - 1 : intervals.size() - 1];
    const VisibleInterval& here = intervals[i];
    if (!continues(before, here, straight_m)) return i;
  }
  return 0;
}

VisibleStretch stretch_from(std::span<const VisibleInterval> intervals, std::size_t first,
                            std::size_t limit, double straight_m) {
  const std::size_t count = intervals.size();
  const VisibleInterval* last = &intervals[first];
  const VisibleInterval& begin = *last;
  VisibleStretch out;
  out.begin = begin.begin;
  out.begin_vertex = begin.begin_vertex;
  out.begin_wall = begin.wall;
  out.longest_wall = begin.wall;
  out.pieces = 1;
  double longest = (begin.end - begin.begin).squaredNorm();
  const VisibleInterval* next = &intervals[(first + 1) % count];
  // The second test keeps many small bends from adding up.
  while (out.pieces < limit && continues(*last, *next, straight_m) &&
         goes_straight(out.begin, next->begin, next->end, straight_m)) {
    last = next;
    ++out.pieces;
    const double length = (last->end - last->begin).squaredNorm();
    if (length > longest) {
      longest = length;
      out.longest_wall = last->wall;
    }
    next = &intervals[(first + out.pieces) % count];
  }
  out.end = last->end;
  out.end_vertex = last->end_vertex;
  out.end_wall = last->wall;
  const VisibleInterval& previous = intervals[(first + count - 1) % count];
  out.begin_kind = end_of(out.begin, begin.begin_kind, share_vertex(previous, begin), previous.end);
  out.end_kind = end_of(out.end, last->end_kind, share_vertex(*last, *next), next->begin);
  return out;
}

}  // namespace adit
