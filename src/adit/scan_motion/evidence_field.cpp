#include "adit/scan_motion/evidence_field.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace adit {
namespace {

constexpr int kMargin = 1 << (EvidenceField::kLevels - 1);  // cells

}  // namespace

void EvidenceField::lay_out(std::span<const PlacedShape> shapes, const FieldOptions& options) {
  cell_m_ = options.cell_m;
  most_reach_ = options.most_reach_m;
  middle_.setZero();
  for (const PlacedShape& s : shapes) middle_ += s.frame_from_shape.translation();
  middle_ /= std::max(1.0, static_cast<double>(shapes.size()));
  Vector2d low = middle_;
  Vector2d high = middle_;
  for (const PlacedShape& s : shapes) {
    const RigidTransform carry_by(s.frame_from_shape);
    for (const SurfacePoint& p : s.shape->points) {
      const Vector2d point = carry_by.point(p.point.cast<double>());
      if ((point - middle_).norm() > most_reach_) continue;
      low = low.cwiseMin(point);
      high = high.cwiseMax(point);
    }
  }
  const double margin = kMargin * cell_m_ + 4.0 * options.blur_m;
  origin_ = low - Vector2d::Constant(margin);
  const Vector2d extent = (high + Vector2d::Constant(margin) - origin_) / cell_m_;
  width_ = static_cast<int>(extent.x()) + 1;
  height_ = static_cast<int>(extent.y()) + 1;
}

void EvidenceField::clear_line(int column0, int row0, int column1, int row1) {
  std::vector<std::uint8_t>& cells = levels_[0];
  const int dx = std::abs(column1 - column0);
  const int dy = std::abs(row1 - row0);
  const int steps = std::max(dx, dy);
  // Short of its end by a cell: the wall itself is not free.
  for (int k = 0; k + 1 < steps; ++k) {
    const int x = column0 + (2 * k * (column1 - column0) + steps) / (2 * steps);
    const int y = row0 + (2 * k * (row1 - row0) + steps) / (2 * steps);
    if (static_cast<unsigned>(x) >= static_cast<unsigned>(width_) ||
        static_cast<unsigned>(y) >= static_cast<unsigned>(height_)) {
      return;
    }
    cells[static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) +
          static_cast<std::size_t>(x)] = 0;
  }
}

void EvidenceField::clear_beams(const PlacedShape& s) {
  const RigidTransform carry_by(s.frame_from_shape);
  const Vector2d eye = carry_by.point(s.shape->eye.cast<double>());
  for (const SurfacePoint& p : s.shape->points) {
    const Vector2d end = carry_by.point(p.point.cast<double>());
    clear_line(column(eye.x()), row(eye.y()), column(end.x()), row(end.y()));
  }
}

void EvidenceField::stamp_walls(double blur_m) {
  const int reach = static_cast<int>(std::ceil(2.5 * blur_m / cell_m_));
  const int side = 2 * reach + 1;
  const auto cells = static_cast<std::size_t>(side);
  std::vector<std::uint8_t> kernel(cells * cells);
  for (int dy = -reach; dy <= reach; ++dy) {
    for (int dx = -reach; dx <= reach; ++dx) {
      const double d2 = (dx * dx + dy * dy) * cell_m_ * cell_m_;
      const int cell = (dy + reach) * side + dx + reach;
      kernel[static_cast<std::size_t>(cell)] =
          static_cast<std::uint8_t>(std::lround(255.0 * std::exp(-0.5 * d2 / (blur_m * blur_m))));
    }
  }
  std::sort(walls_.begin(), walls_.end());
  walls_.erase(std::unique(walls_.begin(), walls_.end()), walls_.end());
  const std::uint32_t width = static_cast<std::uint32_t>(width_);
  for (const std::uint32_t cell : walls_) {
    const int x = static_cast<int>(cell % width);
    const int y = static_cast<int>(cell / width);
    for (int dy = -reach; dy <= reach; ++dy) {
      std::uint8_t* target = levels_[0].data() + (y + dy) * width_ + x - reach;
      const std::uint8_t* from = kernel.data() + (dy + reach) * side;
      for (int k = 0; k < side; ++k) target[k] = std::max(target[k], from[k]);
    }
  }
}

void EvidenceField::raise_levels() {
  const std::size_t width = static_cast<std::size_t>(width_);
  const std::size_t height = static_cast<std::size_t>(height_);
  for (int level = 1; level < kLevels; ++level) {
    const std::vector<std::uint8_t>& below = levels_[static_cast<std::size_t>(level - 1)];
    std::vector<std::uint8_t>& here = levels_[static_cast<std::size_t>(level)];
    here.resize(below.size());
    const std::size_t half = std::size_t{1} << (level - 1);
    for (std::size_t y = 0; y < height; ++y) {
      const std::uint8_t* a = below.data() + y * width;
      const bool leaves = y + half >= height;  // above the grid nothing was seen
      const std::uint8_t* b = leaves ? a : below.data() + (y + half) * width;
      const std::uint8_t least = leaves ? unseen_ : 0;
      std::uint8_t* out = here.data() + y * width;
      for (std::size_t x = 0; x + half < width; ++x) {
        out[x] =
            std::max(least, std::max(std::max(a[x], a[x + half]), std::max(b[x], b[x + half])));
      }
      for (std::size_t x = width > half ? width - half : 0; x < width; ++x) {
        out[x] = std::max({a[x], b[x], unseen_});
      }
    }
  }
}

void EvidenceField::build(std::span<const PlacedShape> shapes, bool with_free,
                          const FieldOptions& options) {
  lay_out(shapes, options);
  unseen_ = with_free ? static_cast<std::uint8_t>(std::lround(255.0 * options.unseen)) : 0;
  levels_.resize(kLevels);
  levels_[0].assign(static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_), unseen_);
  walls_.clear();
  for (const PlacedShape& s : shapes) {
    if (with_free) clear_beams(s);
    const RigidTransform carry_by(s.frame_from_shape);
    for (const SurfacePoint& p : s.shape->points) {
      const Vector2d point = carry_by.point(p.point.cast<double>());
      if ((point - middle_).norm() > most_reach_) continue;
      walls_.push_back(static_cast<std::uint32_t>(row(point.y()) * width_ + column(point.x())));
    }
  }
  stamp_walls(options.blur_m);
  raise_levels();
}

}  // namespace adit
