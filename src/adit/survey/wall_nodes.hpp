#pragma once

#include <vector>

#include "adit/survey/wall_evidence.hpp"

namespace adit {

/// A place on the middle of a wall's band of facets, and what supports it there.
struct WallNode {
  Vector2d point = Vector2d::Zero();
  Vector2d normal = Vector2d::UnitX();  ///< unit, towards the open side
  double visit_information = 0.0;       ///< across the wall, of one visit (1/m²)
  double scatter = 0.0;                 ///< variance of the facets across the wall (m²)
  double hits = 0.0;
  int scans = 0;
  int visits = 0;
  bool sure = false;  ///< met from near or on several visits: neither roof nor floor

  /// The wall's direction, the open side on its left.
  Vector2d along() const { return {normal.y(), -normal.x()}; }
};

/// How far apart nodes lie along a wall (m).
double node_spacing(const WallOptions& options);

/// Thins the facets that stand in place to nodes in the middle of each wall.
///
/// Each facet is moved across its wall to where the facets of the same side are densest (mean shift
/// with a line fitted in a window that is long along the wall and narrow across it), so that layers
/// from poses that err become one, while walls farther apart, and the two sides of a thin wall,
/// stay two. Then the densest are kept, a spacing apart.
std::vector<WallNode> find_wall_nodes(BeamEvidence& evidence, const ScannerModel& scanner,
                                      const WallOptions& options);

}  // namespace adit
