#include "adit/map/merging.hpp"

#include <algorithm>
#include <cmath>

namespace adit {
namespace {

// The directions from an anchor that pass within an offset of all points seen so far.
class Cone {
 public:
  Cone(const Vector2d& anchor, double offset) : anchor_(anchor), offset_(offset) {}

  // True when the segment from the anchor to `point` runs beside all points added, within the
  // offset: in a direction of the cone and at least as far as each of them.
  bool admits(const Vector2d& point) const {
    const Vector2d to = point - anchor_;
    if (to.squaredNorm() <= farthest_squared_) return false;
    return !bounded_ || (cross(right_, to) >= 0.0 && cross(to, left_) >= 0.0);
  }

  void add(const Vector2d& point) {
    const Vector2d to = point - anchor_;
    const double squared = to.squaredNorm();
    farthest_squared_ = std::max(farthest_squared_, squared);
    if (squared <= offset_ * offset_) return;  // any direction passes it
    // The tangents from the anchor to the disc of radius offset around the point.
    const double tangent = std::sqrt(squared - offset_ * offset_);
    const Vector2d left = (to * tangent + perpendicular(to) * offset_) / squared;
    const Vector2d right = (to * tangent - perpendicular(to) * offset_) / squared;
    if (!bounded_ || cross(left, left_) > 0.0) left_ = left;
    if (!bounded_ || cross(right_, right) > 0.0) right_ = right;
    bounded_ = true;
  }

 private:
  Vector2d anchor_;
  double offset_;
  double farthest_squared_ = 0.0;
  bool bounded_ = false;
  Vector2d left_ = Vector2d::Zero();
  Vector2d right_ = Vector2d::Zero();
};

class Merger {
 public:
  Merger(PlanGraph& plan, const CleaningTolerances& tolerances, MapReport& report)
      : plan_(plan),
        tolerances_(tolerances),
        report_(report),
        incidence_(incidence_of(plan.edges, plan.vertices.size())),
        is_done_(plan.edges.size(), 0) {}

  std::vector<int> run() {
    merged_.reserve(plan_.edges.size());
    const auto count = static_cast<int>(plan_.edges.size());
    for (int i = 0; i < count; ++i) {  // chains between two vertices of other degrees than two
      for (const int end : {edge(i).a, edge(i).b}) {
        if (is_done(i) || !ends_chain(end)) continue;
        follow(end, i);
        join_chain();
      }
    }
    for (int i = 0; i < count; ++i) {  // what is left are loops
      if (is_done(i)) continue;
      follow(edge(i).a, i);
      start_loop_at_corner();
      join_chain();
    }
    plan_.edges = std::move(merged_);
    return std::move(moved_);
  }

 private:
  const Edge& edge(int i) const { return plan_.edges[static_cast<std::size_t>(i)]; }
  const Vector2d& position(int v) const { return plan_.vertices[static_cast<std::size_t>(v)]; }
  bool is_done(int i) const { return is_done_[static_cast<std::size_t>(i)] != 0; }
  bool ends_chain(int vertex) const { return incidence_.at(vertex).size() != 2; }

  void follow(int vertex, int first_edge);
  void start_loop_at_corner();
  void join_chain();
  bool leaves_line(int first, int last) const;

  PlanGraph& plan_;
  const CleaningTolerances& tolerances_;
  MapReport& report_;
  Incidence incidence_;
  std::vector<char> is_done_;
  std::vector<Edge> merged_;
  std::vector<int> moved_;
  std::vector<int> chain_;  // vertices; a loop has its first one again at the end
  std::vector<Vector2d> line_;
  std::vector<int> kept_;
};

void Merger::follow(int vertex, int first_edge) {
  chain_.assign(1, vertex);
  int along = first_edge;
  while (!is_done(along)) {
    is_done_[static_cast<std::size_t>(along)] = 1;
    vertex = edge(along).a == vertex ? edge(along).b : edge(along).a;
    chain_.push_back(vertex);
    if (ends_chain(vertex)) return;
    const auto both = incidence_.at(vertex);
    along = both[0] == along ? both[1] : both[0];
  }
}

// A loop has no natural end; it must not get one in the middle of a straight wall.
void Merger::start_loop_at_corner() {
  chain_.pop_back();
  const std::size_t n = chain_.size();
  std::size_t corner = 0;
  double farthest = -1.0;
  for (std::size_t i = 0; i < n; ++i) {
    const Segment across{position(chain_[(i + n - 1) % n]), position(chain_[(i + 1) % n])};
    const double offset = distance(across, position(chain_[i]));
    if (offset <= farthest) continue;
    farthest = offset;
    corner = i;
  }
  std::rotate(chain_.begin(), chain_.begin() + static_cast<std::ptrdiff_t>(corner), chain_.end());
  chain_.push_back(chain_.front());
}

void Merger::join_chain() {
  line_.clear();
  for (const int vertex : chain_) line_.push_back(position(vertex));
  simplify(line_, tolerances_.merge_offset, kept_);
  for (std::size_t i = 0; i + 1 < kept_.size(); ++i) {
    if (leaves_line(kept_[i], kept_[i + 1])) moved_.push_back(static_cast<int>(merged_.size()));
    merged_.push_back({chain_[static_cast<std::size_t>(kept_[i])],
                       chain_[static_cast<std::size_t>(kept_[i + 1])]});
  }
  report_.merged += static_cast<std::int64_t>(chain_.size() - kept_.size());
}

bool Merger::leaves_line(int first, int last) const {
  const auto begin = line_.begin();
  const Segment joined{begin[first], begin[last]};
  return std::any_of(begin + first + 1, begin + last, [&](const Vector2d& left_out) {
    return distance(joined, left_out) > 0.125 * tolerances_.fine;
  });
}

}  // namespace

void simplify(std::span<const Vector2d> line, double offset, std::vector<int>& kept) {
  kept.clear();
  if (line.empty()) return;
  kept.push_back(0);
  Cone cone(line.front(), offset);
  for (std::size_t i = 1; i < line.size(); ++i) {
    if (!cone.admits(line[i])) {
      kept.push_back(static_cast<int>(i - 1));
      cone = Cone(line[i - 1], offset);
    }
    cone.add(line[i]);
  }
  if (line.size() > 1) kept.push_back(static_cast<int>(line.size() - 1));
}

std::vector<int> merge_chains(PlanGraph& plan, const CleaningTolerances& tolerances,
                              MapReport& report) {
  return Merger(plan, tolerances, report).run();
}

}  // namespace adit
