#include "adit/map/plan_graph.hpp"

#include <algorithm>

namespace adit {

std::vector<Segment> segments_of(std::span<const Edge> edges, std::span<const Vector2d> vertices) {
  std::vector<Segment> segments;
  segments.reserve(edges.size());
  for (const Edge& edge : edges) segments.push_back(segment_of(edge, vertices));
  return segments;
}

Incidence incidence_of(std::span<const Edge> edges, std::size_t vertex_count) {
  Incidence result;
  result.first.assign(vertex_count + 1, 0);
  for (const Edge& edge : edges) {
    ++result.first[static_cast<std::size_t>(edge.a)];
    ++result.first[static_cast<std::size_t>(edge.b)];
  }
  int sum = 0;
  for (int& first : result.first) {
    sum += first;
    first = sum;
  }
  // Filled from the back, so that `first` runs down to the begin of each list.
  result.edges.resize(2 * edges.size());
  for (std::size_t i = edges.size(); i-- > 0;) {
    for (const int vertex : {edges[i].a, edges[i].b}) {
      const int slot = --result.first[static_cast<std::size_t>(vertex)];
      result.edges[static_cast<std::size_t>(slot)] = static_cast<int>(i);
    }
  }
  return result;
}

std::int64_t drop_duplicates(PlanGraph& plan) {
  auto& edges = plan.edges;
  std::erase_if(edges, [](const Edge& edge) { return edge.a == edge.b; });
  const Incidence incidence = incidence_of(edges, plan.vertices.size());
  // Walks each vertex's edges and remembers at the other end who came there last; a vertex of
  // degree d costs d, not d squared.
  std::vector<int> reached_from(plan.vertices.size(), -1);
  std::vector<char> is_duplicate(edges.size(), 0);
  for (int v = 0; v < static_cast<int>(plan.vertices.size()); ++v) {
    for (const int i : incidence.at(v)) {
      const Edge& edge = edges[static_cast<std::size_t>(i)];
      int& from = reached_from[static_cast<std::size_t>(edge.a == v ? edge.b : edge.a)];
      if (from == v) is_duplicate[static_cast<std::size_t>(i)] = 1;
      from = v;
    }
  }
  std::size_t kept = 0;
  for (std::size_t i = 0; i < edges.size(); ++i) {
    if (is_duplicate[i] == 0) edges[kept++] = edges[i];
  }
  const auto dropped = static_cast<std::int64_t>(edges.size() - kept);
  edges.resize(kept);
  return dropped;
}

}  // namespace adit
