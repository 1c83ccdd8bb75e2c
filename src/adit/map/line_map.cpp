#include "adit/map/line_map.hpp"

#include <algorithm>
#include <utility>

#include "adit/map/cleaning.hpp"
#include "adit/map/hilbert.hpp"

namespace adit {
namespace {

// Edges along the Hilbert curve, vertices numbered as the edges come to them, those of no edge left
// out: what a query finds lies together in memory.
PlanGraph pack(const PlanGraph& plan) {
  PlanGraph packed;
  packed.edges.reserve(plan.edges.size());
  std::vector<int> new_number(plan.vertices.size(), -1);
  const auto renumber = [&](int vertex) {
    int& number = new_number[static_cast<std::size_t>(vertex)];
    if (number < 0) {
      number = static_cast<int>(packed.vertices.size());
      packed.vertices.push_back(plan.vertices[static_cast<std::size_t>(vertex)]);
    }
    return number;
  };
  for (const int i : hilbert_order(segments_of(plan.edges, plan.vertices))) {
    const Edge& edge = plan.edges[static_cast<std::size_t>(i)];
    const int a = renumber(edge.a);
    packed.edges.push_back({a, renumber(edge.b)});
  }
  return packed;
}

}  // namespace

LineMap LineMap::build(std::span<const Segment> raw, const LineMapOptions& options,
                       MapReport* report) {
  MapReport done;
  PlanGraph plan = pack(clean_plan(raw, options, done));
  done.output = static_cast<std::int64_t>(plan.edges.size());
  if (report != nullptr) *report = done;

  LineMap map;
  map.identity_ = std::make_shared<char>();
  map.walls_.reserve(plan.edges.size());
  for (const Edge& edge : plan.edges) {
    map.walls_.push_back({segment_of(edge, plan.vertices), edge.a, edge.b});
  }
  Incidence incidence = incidence_of(plan.edges, plan.vertices.size());
  map.first_wall_at_ = std::move(incidence.first);
  map.walls_at_ = std::move(incidence.edges);
  map.index_ = SegmentIndex(segments_of(plan.edges, plan.vertices));
  map.vertices_ = std::move(plan.vertices);
  for (const Vector2d& vertex : map.vertices_) map.bounds_.extend(vertex);
  return map;
}

void LineMap::near(const Vector2d& center, double radius, std::vector<int>& found) const {
  if (!(radius >= 0.0)) return;
  const auto old_size = static_cast<std::ptrdiff_t>(found.size());
  const double squared_radius = radius * radius;
  const auto take = [&](const SegmentIndex::Entry& entry) {
    const Segment& s = walls_[static_cast<std::size_t>(entry.segment)].segment;
    const Vector2d from_a = center - s.a;
    // Most walls below the boxes reached have an end inside; that is quickly seen.
    if (entry.pieces == 1 && from_a.squaredNorm() <= squared_radius) {
      found.push_back(entry.segment);
      return;
    }
    const Vector2d along = s.b - s.a;
    const double fraction = std::clamp(from_a.dot(along) / along.squaredNorm(), 0.0, 1.0);
    if ((from_a - along * fraction).squaredNorm() > squared_radius) return;
    if (entry.holds(fraction)) found.push_back(entry.segment);
  };
  index_.visit([&](const Box& box) { return box.squared_distance(center) <= squared_radius; },
               take);
  // Pieces of long walls may stand out of line; without any, this is one pass over what is there.
  if (!std::is_sorted(found.begin() + old_size, found.end())) {
    std::sort(found.begin() + old_size, found.end());
  }
}

}  // namespace adit
