#pragma once

#include "adit/features/features.hpp"
#include "adit/map/line_map.hpp"
#include "adit/visibility/visibility.hpp"

namespace adit {

/// What the scanner could resolve from where it stands.
struct PredictionOptions {
  double min_line_m = 0.3;
  double min_line_rad = 0.02;

  template <class Self, class Field>
  static void visit(Self& self, Field&& field) {
    field("min_line_m", self.min_line_m, "shorter visible pieces of wall make no feature (m)");
    field("min_line_rad", self.min_line_rad,
          "pieces of wall that subtend less make no feature (rad); about four beams of the Cyclone");
  }
};

/// Feature prediction (the paper, III-D): the map's corners and lines visible from `observer`,
/// counter-clockwise. Positions are relative to the observer, axes are the map's. `out` is reused.
void predict_features(const LineMap& map, const Visibility& visibility, const Vector2d& observer,
                      const PredictionOptions& options, FeatureList& out);

}  // namespace adit
