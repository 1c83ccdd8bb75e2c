#include "adit/map/snapping.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include "adit/map/meeting.hpp"
#include "adit/map/spatial_index.hpp"
#include "adit/map/vertex_grid.hpp"

namespace adit {
namespace {

// Below this part of the fine tolerance a shift is none.
constexpr double kUnmoved = 0.125;

// A wall that passes a vertex that is not its own.
struct Passing {
  int wall = 0;
  int vertex = 0;
  bool operator==(const Passing&) const = default;
  bool operator<(const Passing& other) const {
    return wall != other.wall ? wall < other.wall : vertex < other.vertex;
  }
};

// A crossing and the vertex that stands for it.
struct Crossing {
  Vector2d point;
  int vertex = 0;
};

class Snapper {
 public:
  Snapper(std::span<const Segment> raw, const CleaningTolerances& tolerances, MapReport& report)
      : raw_(raw),
        tolerances_(tolerances),
        report_(report),
        vertices_(tolerances.snap, raw.size() + raw.size() / 4) {}

  SnappedPlan run() {
    join_ends();
    drop_collapsed();
    find_meetings();
    pull_ends_to_walls();
    return route();
  }

 private:
  void join_ends();
  void settle_ends();
  void drop_collapsed();
  void find_meetings();
  void meet(int i, int j);
  void add_crossing_vertices(const SegmentIndex& index, std::span<const Vector2d> points);
  void pass_through(int vertex, const SegmentIndex& index);
  void pull_ends_to_walls();
  void pull(int vertex, const Vector2d& to);
  SnappedPlan route();
  bool is_bent(std::size_t wall, std::span<const Passing> on_the_way) const;

  Vector2d position(int vertex) const { return vertices_.position(vertex); }
  Segment& wall(int i) { return walls_[static_cast<std::size_t>(i)]; }
  const Edge& edge(int i) const { return edges_[static_cast<std::size_t>(i)]; }

  std::span<const Segment> raw_;
  const CleaningTolerances& tolerances_;
  MapReport& report_;
  VertexGrid vertices_;         // those of ends come first
  int end_count_ = 0;           // vertices made from ends
  std::vector<Edge> edges_;     // per wall, its ends' vertices
  std::vector<Segment> walls_;  // per wall, the line between those vertices before any pull
  std::vector<Vector2d> crossing_points_;
  std::vector<Crossing> crossings_;
  std::vector<Passing> passings_;
};

// Leader clustering: the first end found somewhere becomes a vertex, and takes the ends near
// itself. Vertices keep the tolerance between them and no chain of near ends can carry one away.
void Snapper::join_ends() {
  const auto vertex_at = [&](const Vector2d& end) {
    const int near = vertices_.nearest(end, tolerances_.snap);
    return near >= 0 ? near : vertices_.add(end);
  };
  edges_.reserve(raw_.size());
  for (const Segment& s : raw_) {
    const int a = vertex_at(s.a);
    edges_.push_back({a, vertex_at(s.b)});
  }
  end_count_ = static_cast<int>(vertices_.positions().size());
  settle_ends();
}

// A vertex made later may lie nearer than the one that an end was first given to.
void Snapper::settle_ends() {
  const auto settle = [&](const Vector2d& end, int& vertex) {
    if (position(vertex) == end) return;
    vertex = vertices_.nearest(end, tolerances_.snap);
    ++report_.snapped_ends;
  };
  for (std::size_t i = 0; i < raw_.size(); ++i) {
    settle(raw_[i].a, edges_[i].a);
    settle(raw_[i].b, edges_[i].b);
  }
}

void Snapper::drop_collapsed() {
  report_.zero_length += static_cast<std::int64_t>(
      std::erase_if(edges_, [](const Edge& edge) { return edge.a == edge.b; }));
  PlanGraph plan{vertices_.positions(), std::move(edges_)};
  report_.duplicates += drop_duplicates(plan);
  edges_ = std::move(plan.edges);
}

void Snapper::find_meetings() {
  walls_ = segments_of(edges_, vertices_.positions());
  const SegmentIndex index(walls_);
  index.visit_close_pairs(walls_, tolerances_.snap, [&](int i, int j) { meet(i, j); });
  add_crossing_vertices(index, crossing_points_);
  std::sort(passings_.begin(), passings_.end());
  passings_.erase(std::unique(passings_.begin(), passings_.end()), passings_.end());
  report_.t_junctions +=
      std::count_if(passings_.begin(), passings_.end(),
                    [&](const Passing& passing) { return passing.vertex < end_count_; });
}

void Snapper::meet(int i, int j) {
  bool touch = false;
  const auto end_beside = [&](int end, int of) {
    if (edge(of).ends_at(end) || !is_beside(wall(of), position(end), tolerances_.snap)) return;
    passings_.push_back({of, end});
    touch = true;
  };
  end_beside(edge(j).a, i);
  end_beside(edge(j).b, i);
  end_beside(edge(i).a, j);
  end_beside(edge(i).b, j);
  // Straight walls meet once: where they share a vertex or touch, they need no second meeting.
  if (touch || edge(i).ends_at(edge(j).a) || edge(i).ends_at(edge(j).b)) return;
  if (const auto point = crossing_of(wall(i), wall(j))) crossing_points_.push_back(*point);
}

void Snapper::add_crossing_vertices(const SegmentIndex& index, std::span<const Vector2d> points) {
  crossings_.reserve(points.size());
  std::vector<char> is_passed(vertices_.positions().size(), 0);
  for (const Vector2d& point : points) {
    int vertex = vertices_.nearest(point, tolerances_.snap);
    if (vertex < 0) {
      vertex = vertices_.add(point);
      is_passed.push_back(0);
      ++report_.crossings;
    }
    crossings_.push_back({point, vertex});
    // Also where the vertex is an end: it may be that of a wall which has collapsed.
    if (std::exchange(is_passed[static_cast<std::size_t>(vertex)], 1) == 0) {
      pass_through(vertex, index);
    }
  }
}

void Snapper::pass_through(int vertex, const SegmentIndex& index) {
  const Vector2d point = position(vertex);
  const double reach = tolerances_.snap * (1.0 + 1e-9);
  index.visit([&](const Box& box) { return box.squared_distance(point) <= reach * reach; },
              [&](const SegmentIndex::Entry& entry) {
                if (edge(entry.segment).ends_at(vertex)) return;
                if (!is_beside(wall(entry.segment), point, reach)) return;
                passings_.push_back({entry.segment, vertex});
              });
}

// An end goes to the crossing that it stands for, else to the nearest wall that it touches.
void Snapper::pull_ends_to_walls() {
  constexpr double kFar = std::numeric_limits<double>::infinity();
  struct Pull {
    double distance = kFar;
    bool to_crossing = false;
    Vector2d target = Vector2d::Zero();
  };
  std::vector<Pull> pulls(static_cast<std::size_t>(end_count_));
  const auto offer = [&](int vertex, const Vector2d& target, bool is_crossing) {
    if (vertex >= end_count_) return;
    Pull& pull = pulls[static_cast<std::size_t>(vertex)];
    const double distance = (target - position(vertex)).norm();
    if (pull.to_crossing == is_crossing ? distance >= pull.distance : pull.to_crossing) return;
    pull = {distance, is_crossing, target};
  };
  for (const auto& [i, vertex] : passings_) {
    offer(vertex, nearest_point(wall(i), position(vertex)), false);
  }
  for (const Crossing& crossing : crossings_) offer(crossing.vertex, crossing.point, true);
  for (int v = 0; v < end_count_; ++v) {
    const Pull& offered = pulls[static_cast<std::size_t>(v)];
    if (offered.distance < kFar) pull(v, offered.target);
  }
}

void Snapper::pull(int vertex, const Vector2d& to) {
  if ((to - position(vertex)).norm() <= kUnmoved * tolerances_.fine) return;
  if (vertices_.nearest(to, tolerances_.snap, vertex) >= 0) return;
  vertices_.move(vertex, to);
  ++report_.snapped_ends;
}

SnappedPlan Snapper::route() {
  SnappedPlan result;
  auto& edges = result.plan.edges;
  edges.reserve(edges_.size() + passings_.size());
  auto next = passings_.begin();
  for (std::size_t i = 0; i < edges_.size(); ++i) {
    const auto first = next;
    while (next != passings_.end() && next->wall == static_cast<int>(i)) ++next;
    const Vector2d start = position(edges_[i].a);
    const Vector2d along = position(edges_[i].b) - start;
    std::sort(first, next, [&](const Passing& one, const Passing& other) {
      return (position(one.vertex) - start).dot(along) <
             (position(other.vertex) - start).dot(along);
    });
    const std::size_t first_edge = edges.size();
    int from = edges_[i].a;
    for (auto passing = first; passing != next; ++passing) {
      edges.push_back({from, passing->vertex});
      from = passing->vertex;
    }
    edges.push_back({from, edges_[i].b});
    if (!is_bent(i, {first, next})) continue;
    for (std::size_t e = first_edge; e < edges.size(); ++e) {
      result.bent.push_back(static_cast<int>(e));
    }
  }
  result.plan.vertices = vertices_.positions();
  return result;
}

bool Snapper::is_bent(std::size_t wall, std::span<const Passing> on_the_way) const {
  const Segment& straight = walls_[wall];
  const double unmoved = kUnmoved * tolerances_.fine;
  if (position(edges_[wall].a) != straight.a || position(edges_[wall].b) != straight.b) return true;
  return std::any_of(on_the_way.begin(), on_the_way.end(), [&](const Passing& passing) {
    return distance(straight, position(passing.vertex)) > unmoved;
  });
}

}  // namespace

SnappedPlan snap_plan(std::span<const Segment> walls, const CleaningTolerances& tolerances,
                      MapReport& report) {
  return Snapper(walls, tolerances, report).run();
}

}  // namespace adit
