#pragma once

#include <optional>
#include <vector>

#include "adit/plot/painter.hpp"
#include "adit/plot/sheet.hpp"

namespace adit {

/// Where a panel lies: its caption and scale bar stand above and below `body`, coordinates around.
struct PlacedPanel {
  const Panel* panel = nullptr;
  PageRect body;
  std::optional<double> bar_y;  ///< middle of its own scale bar
};

/// Where an entry of the footer lies: middle of its left side.
struct PlacedEntry {
  const LegendEntry* entry = nullptr;  ///< none for the scale bar
  Vector2d at = Vector2d::Zero();
};

/// Everything in its place, before the page exists: its height follows from its contents.
struct PageLayout {
  Vector2d size = Vector2d::Zero();
  double title_y = 0.0;  ///< middle of the title
  std::vector<PlacedPanel> panels;
  std::vector<PlacedEntry> footer;
};

inline constexpr double kPageMargin = 8.0;  // points

/// Width of a legend entry's sample (points).
double sample_width(const LegendEntry& entry);

/// The length of the scale bar at this scale (m): round, near a fifth of `width` points.
double scale_bar_length(double points_per_metre, double width);

/// Arranges the panels and the footer; `ruler` measures the words.
PageLayout lay_out(const std::vector<std::vector<Panel>>& rows,
                   const std::vector<LegendEntry>& legend, const PictureOptions& options,
                   Painter& ruler);

}  // namespace adit
