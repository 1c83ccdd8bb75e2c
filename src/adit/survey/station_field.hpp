#pragma once

#include <span>
#include <vector>

#include "adit/survey/wall_grid.hpp"
#include "adit/survey/wall_hits.hpp"

namespace adit {

/// A piece of surface as seen from a station.
struct StationPoint {
  Vector2d point = Vector2d::Zero();
  Vector2d normal = Vector2d::UnitX();  ///< unit, towards the scanner
};

/// Points thinned to one in each square of `spacing_m`, so that near walls do not outweigh far
/// ones.
std::vector<StationPoint> thin_points(std::span<const StationPoint> points, double spacing_m);

/// Where a station saw surfaces, blurred, in its own frame: how well a point of another scan agrees
/// (a likelihood field: Thrun et al. 2005, section 6.4, with the surface's direction).
class StationField {
 public:
  StationField(std::span<const StationPoint> points, double blur_m);

  /// From 0 to 1: nearness of a like surface times the cosine between the two.
  double agreement(const Vector2d& point, const Vector2d& normal) {
    const Cell* cell = cells_.find(cells_.cell_at(point));
    if (cell == nullptr || cell->nearness == 0.0F) return 0.0;
    const double cosine = normal.x() * static_cast<double>(cell->normal_x) +
                          normal.y() * static_cast<double>(cell->normal_y);
    return cosine > 0.0 ? static_cast<double>(cell->nearness) * cosine : 0.0;
  }

  /// Mean agreement of a station's points, carried into this field's frame.
  double mean_agreement(std::span<const StationPoint> points, const Pose2& field_from_points);

 private:
  struct Cell {
    float nearness = 0.0F;
    float normal_x = 0.0F;
    float normal_y = 0.0F;
  };
  TileGrid<Cell> cells_;
};

}  // namespace adit
