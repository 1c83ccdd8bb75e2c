#pragma once

#include <cstdint>
#include <vector>

#include "adit/plot/page_path.hpp"

namespace adit {

/// Finds places for labels where little is drawn already: a coarse raster of the page counts the
/// ink, and each label takes the cheapest of a fixed set of places around its anchor.
class LabelPlacer {
 public:
  explicit LabelPlacer(const PageRect& area);

  /// A line of this width (points).
  void occupy(const PathPoints& path, double width);
  void occupy(const PageRect& rect, int weight);

  struct Spot {
    PageRect box;          ///< of the text
    bool crowded = false;  ///< something is drawn below it
    bool is_away = false;  ///< so far from its anchor that a leader line helps
  };
  /// The best spot for a text of `size` near `anchor`, at least `clearance` away from it; the spot
  /// counts as occupied from then on.
  Spot place(const Vector2d& anchor, double clearance, const Vector2d& size);

 private:
  double cost(const PageRect& box) const;
  int column(double x) const;
  int row(double y) const;
  void add(int column, int row, int weight);

  PageRect area_;
  int columns_ = 0;
  int rows_ = 0;
  std::vector<std::uint16_t> ink_;
};

}  // namespace adit
