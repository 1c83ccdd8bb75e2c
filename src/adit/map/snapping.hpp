#pragma once

#include <span>
#include <vector>

#include "adit/map/line_map.hpp"
#include "adit/map/plan_graph.hpp"

namespace adit {

/// Distances that the steps of cleaning work with (m), each above the rounding of the coordinates.
struct CleaningTolerances {
  double snap = 0.0;  ///< drawing accuracy: ends and walls nearer than this are meant to meet
  double fine = 0.0;  ///< what counts as touching once the plan is snapped
  double merge_offset = 0.0;  ///< how far a dropped vertex may lie from the merged wall
};

/// A plan after snapping, and the edges that no longer follow the raw walls to within the fine
/// tolerance: they may meet others where the raw walls did not.
struct SnappedPlan {
  PlanGraph plan;
  std::vector<int> bent;
};

/// Snap rounding with the vertices as hot pixels (Hobby 1999; Guibas & Marimont 1998): ends within
/// the tolerance share a vertex, crossings get one, and every wall is led through each vertex
/// within the tolerance of it. Ends that nearly touch a wall are first pulled onto it, so that the
/// wall stays straight. No vertex is farther than twice the tolerance from a raw end or crossing: a
/// vertex is the first end that was found there and attracts only what lies near itself.
///
/// `walls` are finite and in Hilbert order.
SnappedPlan snap_plan(std::span<const Segment> walls, const CleaningTolerances& tolerances,
                      MapReport& report);

}  // namespace adit
