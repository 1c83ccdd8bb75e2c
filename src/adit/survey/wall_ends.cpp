#include "adit/survey/wall_ends.hpp"

#include <algorithm>
#include <optional>

#include "adit/map/spatial_index.hpp"
#include "adit/survey/wall_polyline.hpp"

namespace adit {
namespace {

constexpr double kLeastSine = 0.25;  // flatter walls meet too far away to say where
constexpr double kLeastLeft = 0.1;   // m of an end piece that stay
constexpr int kMostPasses = 2;       // beams that can have strayed

/// An open end of a line: where its last piece leads.
struct OpenEnd {
  Vector2d inner;  // the vertex before
  Vector2d end;
  int piece = 0;      // among all pieces of all lines
  int neighbour = 0;  // the piece before it on its line, itself if alone
};

class EndJoiner {
 public:
  EndJoiner(std::span<const Segment> walls, BeamEvidence& evidence, const WallOptions& options)
      : walls_(walls), index_(walls), evidence_(evidence), options_(options) {}

  /// Where the end should be; nothing where it is well.
  std::optional<Vector2d> better_end(const OpenEnd& at) {
    const Vector2d way = at.end - at.inner;
    const double length = way.norm();
    if (length <= kLeastLeft) return std::nullopt;
    const Vector2d along = way / length;
    const double from = std::max(kLeastLeft, length - options_.corner_gap_m);
    const double to = length + options_.corner_gap_m;
    const double meets = first_meeting(at, along, from, to);
    if (meets > to || (meets > length && is_open(at.end, at.inner + meets * along))) {
      return std::nullopt;
    }
    return at.inner + meets * along;
  }

 private:
  /// Distance from the inner vertex to the first wall met between `from` and `to`, else beyond.
  double first_meeting(const OpenEnd& at, const Vector2d& along, double from, double to) const {
    double first = 2.0 * to + 1.0;
    const Box reach = box_of({at.inner + from * along, at.inner + to * along});
    index_.visit([&](const Box& box) { return box.overlaps(reach); },
                 [&](const SegmentIndex::Entry& entry) {
                   if (entry.segment == at.piece || entry.segment == at.neighbour) return;
                   const Segment& wall = walls_[static_cast<std::size_t>(entry.segment)];
                   const Vector2d side = wall.b - wall.a;
                   const double sine = cross(along, side);
                   if (std::abs(sine) < kLeastSine * side.norm()) return;
                   const double meets = cross(wall.a - at.inner, side) / sine;
                   const double share = cross(wall.a - at.inner, along) / sine;
                   if (share < 0.0 || share > 1.0 || meets < from || meets > to) return;
                   first = std::min(first, meets);
                 });
    return first;
  }

  bool is_open(const Vector2d& from, const Vector2d& to) {
    const int steps = static_cast<int>((to - from).norm() / evidence_.cell_m());
    int open = 0;
    for (int i = 1; i < steps; ++i) {
      const Vector2d place = from + (to - from) * (static_cast<double>(i) / steps);
      if (evidence_.passes_at(place) > kMostPasses) ++open;
    }
    return open >= 2;
  }

  std::span<const Segment> walls_;
  SegmentIndex index_;
  BeamEvidence& evidence_;
  const WallOptions& options_;
};

}  // namespace

void join_ends(std::vector<SurveyedWallLine>& lines, BeamEvidence& evidence,
               const WallOptions& options) {
  std::vector<Segment> walls;
  for (const SurveyedWallLine& line : lines) {
    for (const SurveyedWall& piece : line.pieces) walls.push_back(piece.segment);
  }
  EndJoiner joiner(walls, evidence, options);
  int first = 0;
  for (SurveyedWallLine& line : lines) {
    const int last = first + static_cast<int>(line.pieces.size()) - 1;
    const Segment begin = line.pieces.front().segment;
    const Segment end = line.pieces.back().segment;
    if (!line.closed) {
      bool moved = false;
      if (const auto p = joiner.better_end({begin.b, begin.a, first, std::min(first + 1, last)})) {
        line.pieces.front().segment.a = line.vertices.front() = *p;
        moved = true;
      }
      if (const auto p = joiner.better_end({end.a, end.b, last, std::max(last - 1, first)})) {
        line.pieces.back().segment.b = line.vertices.back() = *p;
        moved = true;
      }
      if (moved) set_vertex_covariances(line);
    }
    first = last + 1;
  }
}

}  // namespace adit
