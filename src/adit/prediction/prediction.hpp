#pragma once

#include "adit/features/features.hpp"
#include "adit/map/line_map.hpp"
#include "adit/visibility/visibility.hpp"

namespace adit {

/// What the scanner could resolve from where it stands.
struct PredictionOptions {
  double min_line_m = 0.3;
  double min_line_rad = 0.02;
  double min_bend_rad = 0.05;
  double straight_m = 0.02;

  template <class Self, class Field>
  static void visit(Self& self, Field&& field) {
    field("min_line_m", self.min_line_m, "shorter visible pieces of wall make no feature (m)");
    field(
        "min_line_rad", self.min_line_rad,
        "pieces of wall that subtend less make no feature (rad); about four beams of the Cyclone");
    field("min_bend_rad", self.min_bend_rad,
          "two walls that meet at less from a straight line make no corner (rad); about 3 degrees, "
          "below which the point where they meet is badly known");
    field(
        "straight_m", self.straight_m,
        "neighbouring walls that depart from one straight line by less are one line (m); twice the "
        "drawing accuracy of mine plans");
  }
};

/// Feature prediction (the paper, III-D): the map's corners and lines visible from `observer`,
/// counter-clockwise. Positions are relative to the observer, axes are the map's. `out` is reused.
///
/// A line is a straight visible stretch that is long and wide enough to be resolved. Where a plan
/// draws one straight wall in pieces (another wall ends at its back, say) the stretch is one line,
/// and `segment` is its longest piece; where something nearer cuts a wall, each visible piece is a
/// line of its own with the same `segment`.
///
/// A corner is a visible vertex between two stretches, or one where the wall ends and the view goes
/// on behind (occluding). The edge of a shadow on a far wall is none, and neither is a bend below
/// `min_bend_rad`. A scanner finds a corner as the meeting of two lines or as the end of one before
/// a drop. So both arms must be resolved, or one that ends in a drop; where the second wall is
/// there but too small to resolve and the view drops behind it, the corner counts as occluding with
/// one arm; every other corner with an unresolved arm is left out.
void predict_features(const LineMap& map, const Visibility& visibility, const Vector2d& observer,
                      const PredictionOptions& options, FeatureList& out);

}  // namespace adit
