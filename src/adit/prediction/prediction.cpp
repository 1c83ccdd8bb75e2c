#include "adit/prediction/prediction.hpp"

#include <cmath>
#include <optional>

#include "adit/geometry/angle.hpp"
#include "adit/prediction/stretch.hpp"

namespace adit {
namespace {

double bearing_of(const Vector2d& v) { return wrap_angle(std::atan2(v.y(), v.x())); }

/// A stretch, the bearings of its ends, and its line.
struct Resolved {
  VisibleStretch stretch;
  double begin_bearing = 0.0;
  double end_bearing = 0.0;  // not below begin_bearing; beyond pi when the stretch spans it
  double orientation = 0.0;  // outward normal
  int line = -1;             // index of its line feature, -1 where it is not resolved
};

/// Two directions out of a vertex, as the paper describes a corner.
struct Opening {
  double concave_angle = 0.0;
  double bisector = 0.0;
};

Opening opening_between(double arm_a, double arm_b) {
  const double turn = angle_between(arm_a, arm_b);
  return {std::abs(turn), wrap_angle(arm_a + 0.5 * turn)};
}

/// Direction from the vertex along the only other wall there; nothing when there is none or more
/// than one.
std::optional<double> other_wall_direction(const LineMap& map, int vertex, int known_wall) {
  int other = -1;
  for (const int wall : map.walls_at(vertex)) {
    if (wall == known_wall) continue;
    if (other >= 0) return std::nullopt;
    other = wall;
  }
  if (other < 0) return std::nullopt;
  const Wall& wall = map.walls()[static_cast<std::size_t>(other)];
  const Vector2d along = wall.segment.b - wall.segment.a;
  return bearing_of(wall.vertex_a == vertex ? along : Vector2d(-along));
}

class Predictor {
 public:
  Predictor(const LineMap& map, const Vector2d& observer, const PredictionOptions& options,
            FeatureList& out)
      : map_(map), observer_(observer), options_(options), out_(out) {}

  /// Adds the line of a stretch, if it can be resolved; `previous` saves the bearing of a shared
  /// vertex.
  Resolved resolve(const VisibleStretch& stretch, const Resolved* previous);

  /// Adds the corner between two stretches that follow each other, if there is one.
  void add_corner(const Resolved& before, const Resolved& after);

  /// Puts the order right: it is, but for what lies on the other side of bearing pi.
  void finish_order();

 private:
  void add_joined_corner(const Resolved& before, const Resolved& after);
  void add_end_corner(const Resolved& side, bool after_vertex);
  Corner corner_at(int vertex) const;
  void push(const Corner& corner, double bearing);

  const LineMap& map_;
  const Vector2d& observer_;
  const PredictionOptions& options_;
  FeatureList& out_;
};

Resolved Predictor::resolve(const VisibleStretch& stretch, const Resolved* previous) {
  Resolved out;
  out.stretch = stretch;
  const bool shared = previous != nullptr && previous->stretch.end == stretch.begin;
  out.begin_bearing = shared ? wrap_angle(previous->end_bearing) : bearing_of(stretch.begin);
  out.end_bearing = bearing_of(stretch.end);
  if (out.end_bearing < out.begin_bearing) out.end_bearing += kTwoPi;
  const Vector2d along = stretch.end - stretch.begin;
  out.orientation = bearing_of(-perpendicular(along));
  const double length = along.norm();
  const double subtended = out.end_bearing - out.begin_bearing;
  if (length < options_.min_line_m || subtended < options_.min_line_rad) return out;

  out.line = static_cast<int>(out_.lines.size());
  Line& line = out_.lines.emplace_back();
  line.begin = stretch.begin;
  line.end = stretch.end;
  line.orientation = out.orientation;
  line.distance = cross(stretch.begin, along) / length;
  line.segment = stretch.longest_wall;
  out_.order.push_back(
      {FeatureKind::line, out.line, wrap_angle(out.begin_bearing + 0.5 * subtended)});
  return out;
}

void Predictor::add_corner(const Resolved& before, const Resolved& after) {
  if (before.stretch.end_kind == StretchEnd::joined) {
    add_joined_corner(before, after);
    return;
  }
  if (before.stretch.end_kind == StretchEnd::drop && before.line >= 0) {
    add_end_corner(before, false);
  }
  if (after.stretch.begin_kind == StretchEnd::drop && after.line >= 0) {
    add_end_corner(after, true);
  }
}

// The arms leave the vertex against the first line and along the second; a line runs a quarter turn
// ahead of its outward normal.
void Predictor::add_joined_corner(const Resolved& before, const Resolved& after) {
  if (before.line < 0 && after.line < 0) return;
  const Opening opening =
      opening_between(after.orientation + 0.5 * kPi, before.orientation - 0.5 * kPi);
  if (kPi - opening.concave_angle < options_.min_bend_rad) return;
  const double range_squared = before.stretch.end.squaredNorm();
  if (before.line < 0 && (before.stretch.begin_kind != StretchEnd::drop ||
                          before.stretch.begin.squaredNorm() < range_squared)) {
    return;
  }
  if (after.line < 0 && (after.stretch.end_kind != StretchEnd::drop ||
                         after.stretch.end.squaredNorm() < range_squared)) {
    return;
  }
  Corner corner = corner_at(before.stretch.end_vertex);
  corner.arms = {before.line, after.line};
  corner.occluding = before.line < 0 || after.line < 0;
  corner.concave_angle = opening.concave_angle;
  corner.bisector = opening.bisector;
  push(corner, wrap_angle(before.end_bearing));
}

void Predictor::add_end_corner(const Resolved& side, bool after_vertex) {
  const VisibleStretch& stretch = side.stretch;
  const int vertex = after_vertex ? stretch.begin_vertex : stretch.end_vertex;
  Corner corner = corner_at(vertex);
  corner.arms[after_vertex ? 1 : 0] = side.line;
  corner.occluding = true;
  const double arm = side.orientation + (after_vertex ? 0.5 * kPi : -0.5 * kPi);
  const int wall = after_vertex ? stretch.begin_wall : stretch.end_wall;
  if (const std::optional<double> other = other_wall_direction(map_, vertex, wall)) {
    const Opening opening = opening_between(arm, *other);
    corner.concave_angle = opening.concave_angle;
    corner.bisector = opening.bisector;
  }
  push(corner, after_vertex ? side.begin_bearing : wrap_angle(side.end_bearing));
}

Corner Predictor::corner_at(int vertex) const {
  Corner corner;
  corner.position = map_.vertices()[static_cast<std::size_t>(vertex)] - observer_;
  corner.vertex = vertex;
  return corner;
}

void Predictor::push(const Corner& corner, double bearing) {
  out_.order.push_back({FeatureKind::corner, static_cast<int>(out_.corners.size()), bearing});
  out_.corners.push_back(corner);
}

void Predictor::finish_order() {
  const auto before = [](const FeatureRef& a, const FeatureRef& b) {
    if (a.azimuth != b.azimuth) return a.azimuth < b.azimuth;
    if (a.kind != b.kind) return a.kind < b.kind;
    return a.index < b.index;
  };
  // Insertion sort: linear on what is almost sorted.
  std::vector<FeatureRef>& order = out_.order;
  for (std::size_t i = 1; i < order.size(); ++i) {
    const FeatureRef moved = order[i];
    std::size_t place = i;
    for (; place > 0 && before(moved, order[place - 1]); --place) order[place] = order[place - 1];
    order[place] = moved;
  }
}

}  // namespace

void predict_features(const LineMap& map, const Visibility& visibility, const Vector2d& observer,
                      const PredictionOptions& options, FeatureList& out) {
  out.clear();
  const std::span<const VisibleInterval> intervals = visibility.intervals();
  if (intervals.empty()) return;
  Predictor predictor(map, observer, options, out);
  const std::size_t start = first_stretch(intervals, options.straight_m);
  Resolved first;
  Resolved before;
  for (std::size_t done = 0; done < intervals.size();) {
    const VisibleStretch stretch = stretch_from(intervals, (start + done) % intervals.size(),
                                                intervals.size() - done, options.straight_m);
    const Resolved here = predictor.resolve(stretch, done > 0 ? &before : nullptr);
    if (done > 0) {
      predictor.add_corner(before, here);
    } else {
      first = here;
    }
    before = here;
    done += stretch.pieces;
  }
  predictor.add_corner(before, first);
  predictor.finish_order();
}

}  // namespace adit
