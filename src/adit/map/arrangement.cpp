#include "adit/map/arrangement.hpp"

#include <algorithm>
#include <vector>

#include "adit/map/meeting.hpp"
#include "adit/map/spatial_index.hpp"
#include "adit/map/vertex_grid.hpp"

namespace adit {
namespace {

// An edge, or what became of it: two children that lie close to it.
struct Piece {
  Edge edge;
  int given = -1;  // the edge that it is a part of
  int child = -1;  // the first of two neighbouring ones
};

// Splits within the fine tolerance may add up; a search looks this many farther.
constexpr double kReach = 64.0;

class Arrangement {
 public:
  Arrangement(PlanGraph& plan, double touch, const CleaningTolerances& tolerances,
              MapReport& report)
      : plan_(plan),
        fine_(tolerances.fine),
        touch_(touch),
        reach_(2.0 * touch + kReach * tolerances.fine),
        report_(report),
        vertices_(tolerances.snap, plan.vertices.size()) {
    for (const Vector2d& vertex : plan.vertices) vertices_.add(vertex);
    pieces_.reserve(plan.edges.size());
    for (const Edge& edge : plan.edges) {
      pieces_.push_back({edge, static_cast<int>(pieces_.size())});
    }
    index_ = SegmentIndex(segments_of(plan.edges, plan.vertices));
  }

  void run(std::span<const int> suspects) {
    todo_.assign(suspects.rbegin(), suspects.rend());
    while (!todo_.empty()) {
      const int piece = todo_.back();
      todo_.pop_back();
      if (is_whole(piece)) check(piece);
    }
    write_back();
  }

 private:
  bool is_whole(int piece) const { return at(piece).child < 0; }
  const Piece& at(int piece) const { return pieces_[static_cast<std::size_t>(piece)]; }
  Segment segment(int piece) const { return segment_of(at(piece).edge, vertices_.positions()); }

  void check(int piece);
  bool meet(int p, int q);
  bool split_at_ends_of(int touching, int touched);
  bool is_touched(int piece, int vertex) const;
  bool split_at_crossing(int p, int q);
  bool split(int piece, int vertex);
  void write_back();

  PlanGraph& plan_;
  double fine_;
  double touch_;
  double reach_;
  MapReport& report_;
  VertexGrid vertices_;
  SegmentIndex index_;         // of the edges given
  std::vector<Piece> pieces_;  // the edges given, then the children
  std::vector<int> todo_;
  std::vector<int> near_;
};

// Compares one whole piece with all others near until it is split or all were seen.
void Arrangement::check(int piece) {
  const Box around = box_of(segment(piece)).padded(reach_);
  near_.clear();
  index_.visit([&](const Box& box) { return box.overlaps(around); },
               [&](const SegmentIndex::Entry& entry) { near_.push_back(entry.segment); });
  while (!near_.empty()) {
    const int other = near_.back();
    near_.pop_back();
    if (other == piece || !box_of(segment(other)).padded(reach_).overlaps(around)) continue;
    if (!is_whole(other) || meet(piece, other)) {
      if (!is_whole(piece)) return;
      near_.push_back(at(other).child + 1);
      near_.push_back(at(other).child);
    }
  }
}

// True when either was split.
bool Arrangement::meet(int p, int q) {
  if (split_at_ends_of(q, p)) return true;
  if (split_at_ends_of(p, q)) return true;
  return split_at_crossing(p, q);
}

bool Arrangement::split_at_ends_of(int touching, int touched) {
  const Edge ends = at(touching).edge;
  for (const int end : {ends.a, ends.b}) {
    if (is_touched(touched, end) && split(touched, end)) {
      ++report_.t_junctions;
      return true;
    }
  }
  return false;
}

bool Arrangement::is_touched(int piece, int vertex) const {
  const Piece& touched = at(piece);
  const Segment whole = segment(piece);
  const Vector2d& point = vertices_.position(vertex);
  if (touched.edge.ends_at(vertex) || !is_beside(whole, point, std::max(touch_, 0.5 * fine_))) {
    return false;
  }
  if (is_beside(whole, point, 0.5 * fine_)) return true;
  const Edge& given = plan_.edges[static_cast<std::size_t>(touched.given)];
  return (point - whole.a).norm() > touch_ && (point - whole.b).norm() > touch_ &&
         distance(segment_of(given, vertices_.positions()), point) <= touch_;
}

bool Arrangement::split_at_crossing(int p, int q) {
  const Edge ends = at(p).edge;
  if (ends.ends_at(at(q).edge.a) || ends.ends_at(at(q).edge.b)) return false;
  const auto point = crossing_of(segment(p), segment(q));
  if (!point) return false;
  int vertex = vertices_.nearest(*point, fine_);
  if (vertex < 0) {
    vertex = vertices_.add(*point);
    ++report_.crossings;
  }
  const bool split_p = !at(p).edge.ends_at(vertex) && split(p, vertex);
  const bool split_q = !at(q).edge.ends_at(vertex) && split(q, vertex);
  return split_p || split_q;
}

// Only into shorter pieces: this is what makes the splitting end. What a vertex at the very end of
// a piece would refuse here is a touch at the scale of rounding.
bool Arrangement::split(int piece, int vertex) {
  const Segment whole = segment(piece);
  const Vector2d middle = vertices_.position(vertex);
  const double limit = (whole.b - whole.a).squaredNorm();
  if ((middle - whole.a).squaredNorm() >= limit || (middle - whole.b).squaredNorm() >= limit) {
    return false;
  }
  const Edge edge = at(piece).edge;
  const int given = at(piece).given;
  const int child = static_cast<int>(pieces_.size());
  pieces_[static_cast<std::size_t>(piece)].child = child;
  pieces_.push_back({{edge.a, vertex}, given});
  pieces_.push_back({{vertex, edge.b}, given});
  todo_.push_back(child + 1);
  todo_.push_back(child);
  return true;
}

void Arrangement::write_back() {
  plan_.vertices = vertices_.positions();
  plan_.edges.clear();
  for (const Piece& piece : pieces_) {
    if (piece.child < 0) plan_.edges.push_back(piece.edge);
  }
}

}  // namespace

void resolve_meetings(PlanGraph& plan, std::span<const int> suspects, double touch,
                      const CleaningTolerances& tolerances, MapReport& report) {
  if (!suspects.empty()) Arrangement(plan, touch, tolerances, report).run(suspects);
}

}  // namespace adit
