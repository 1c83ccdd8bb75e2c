#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "adit/scan_motion/surface_points.hpp"

namespace adit {

/// A scan's points and where they were seen from, in a common frame.
struct PlacedShape {
  const ScanShape* shape = nullptr;
  Pose2 frame_from_shape;
};

/// How well a point would go with what scans saw: a grid of bytes, 255 on a wall, falling off
/// around it, 0 where beams passed, and between for what was not seen.
///
/// Above the grid lie the largest values within 2, 4, 8 ... cells to the right and upwards, so that
/// one value bounds those of many shifts (Olson 2009; Hess et al. 2016).
class EvidenceField {
 public:
  static constexpr int kLevels = 6;

  /// `with_free`: whether beams show what is free. Without, all but walls is worth nothing.
  void build(std::span<const PlacedShape> shapes, bool with_free, const FieldOptions& options);

  double cell_m() const { return cell_m_; }
  /// The cell of a point; not necessarily one of the grid.
  int column(double x) const { return static_cast<int>(std::floor((x - origin_.x()) / cell_m_)); }
  int row(double y) const { return static_cast<int>(std::floor((y - origin_.y()) / cell_m_)); }
  /// The largest value of the cells [column, column + 2^level) x [row, row + 2^level).
  std::uint8_t at(int level, int column, int row) const {
    if (static_cast<unsigned>(column) >= static_cast<unsigned>(width_) ||
        static_cast<unsigned>(row) >= static_cast<unsigned>(height_)) {
      return unseen_;
    }
    return levels_[static_cast<std::size_t>(level)]
                  [static_cast<std::size_t>(row) * static_cast<std::size_t>(width_) +
                   static_cast<std::size_t>(column)];
  }

 private:
  void lay_out(std::span<const PlacedShape> shapes, const FieldOptions& options);
  void clear_beams(const PlacedShape& shape);
  void clear_line(int column0, int row0, int column1, int row1);
  void stamp_walls(double blur_m);
  void raise_levels();

  double cell_m_ = 0.1;
  double most_reach_ = 30.0;
  Vector2d origin_ = Vector2d::Zero();
  Vector2d middle_ = Vector2d::Zero();
  int width_ = 0;
  int height_ = 0;
  std::uint8_t unseen_ = 0;
  std::vector<std::uint32_t> walls_;  // cells
  std::vector<std::vector<std::uint8_t>> levels_;
};

}  // namespace adit
