#pragma once

#include <cstdint>
#include <vector>

#include "adit/geometry/pose2.hpp"
#include "adit/geometry/segment.hpp"

namespace adit {

/// What tells one side of a panel of equal pillars from the others.
enum class PanelMark {
  none,            ///< nothing: each pose has three others that see the same
  missing_pillar,  ///< a pillar that was taken
  entry,           ///< the only drift through the outline, and another pitch in y than in x
};

/// A panel of side * side pillars in an outline.
struct PanelLayout {
  int side = 20;
  double pitch_x_m = 20.0;
  double pitch_y_m = 20.0;
  double street_m = 6.0;     ///< width of the openings
  double variation_m = 0.0;  ///< of the pillars' sides
  PanelMark mark = PanelMark::none;

  double width_m() const { return side * pitch_x_m + street_m; }
  double height_m() const { return side * pitch_y_m + street_m; }
};

std::vector<Segment> panel_walls(const PanelLayout& panel, std::uint64_t seed);

/// Places in the openings, a metre and a half clear of the pillars.
std::vector<Pose2> places_in_panel(const PanelLayout& panel, int count, std::uint64_t seed);

/// A drive along the openings: from where the mark is out of sight, past it.
std::vector<Pose2> drive_past_mark(const PanelLayout& panel, std::uint64_t seed);

}  // namespace adit
