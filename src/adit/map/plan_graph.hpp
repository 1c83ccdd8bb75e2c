#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "adit/geometry/segment.hpp"

namespace adit {

/// A straight connection of two vertices, by their numbers.
struct Edge {
  int a = -1;
  int b = -1;

  bool ends_at(int vertex) const { return a == vertex || b == vertex; }
};

/// A plan under cleaning: edges between numbered vertices (m, map frame).
struct PlanGraph {
  std::vector<Vector2d> vertices;
  std::vector<Edge> edges;
};

/// The edge as a segment.
inline Segment segment_of(const Edge& edge, std::span<const Vector2d> vertices) {
  return {vertices[static_cast<std::size_t>(edge.a)], vertices[static_cast<std::size_t>(edge.b)]};
}

/// All edges as segments.
std::vector<Segment> segments_of(std::span<const Edge> edges, std::span<const Vector2d> vertices);

/// For each vertex the edges that end there: those of v are `edges[first[v]] ...
/// edges[first[v+1]-1]` in ascending order.
struct Incidence {
  std::vector<int> first;
  std::vector<int> edges;

  std::span<const int> at(int vertex) const {
    const auto begin = static_cast<std::size_t>(first[static_cast<std::size_t>(vertex)]);
    const auto end = static_cast<std::size_t>(first[static_cast<std::size_t>(vertex) + 1]);
    return {edges.data() + begin, end - begin};
  }
};

/// Finds the edges at each of `vertex_count` vertices.
Incidence incidence_of(std::span<const Edge> edges, std::size_t vertex_count);

/// Drops edges from a vertex to itself and all but the first of edges with the same ends, whatever
/// their direction; the others keep their order. Returns how many duplicates there were.
std::int64_t drop_duplicates(PlanGraph& plan);

}  // namespace adit
