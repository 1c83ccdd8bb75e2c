#pragma once

#include <optional>
#include <string>
#include <vector>

#include "adit/geometry/pose2.hpp"
#include "adit/plot/page_path.hpp"
#include "adit/plot/style.hpp"

namespace adit {

class Painter;

/// One curve or cloud of a chart; a point that is not finite interrupts the curve.
struct ChartSeries {
  std::string name;  ///< in the legend; empty for none
  std::vector<Vector2d> points;
  std::optional<Stroke> stroke = Stroke{};
  std::optional<MarkStyle> mark;
};

/// A horizontal line across a chart: a threshold, a bound.
struct ChartLevel {
  std::string name;  ///< in the legend; empty for none
  double value = 0.0;
  Stroke stroke{kGrey, 0.7, Dash::dashed};
};

/// A stretch of the x axis that is shaded from bottom to top, behind the curves.
struct ChartBand {
  double from = 0.0;
  double to = 0.0;
  Colour fill;
};

/// Words at a point of a chart.
struct ChartLabel {
  Vector2d at = Vector2d::Zero();
  std::string words;
  TextStyle style = kNumberText;
};

/// Curves over a common axis.
struct Chart {
  std::string x_label;
  std::string y_label;
  std::vector<ChartSeries> series;
  std::vector<ChartLevel> levels;
  std::vector<ChartLabel> labels;
  std::vector<ChartBand> bands;
  bool log_y = false;         ///< values that are not above zero are left out
  bool from_zero = true;      ///< the linear y axis includes zero
  double height_ratio = 0.5;  ///< height over width
  std::string caption;

  /// Draws axes and curves into a rectangle of the page.
  void draw(Painter& painter, const PageRect& area) const;
};

}  // namespace adit
