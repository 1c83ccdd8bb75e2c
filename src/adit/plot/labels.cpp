#include "adit/plot/labels.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace adit {
namespace {

constexpr double kCell = 1.5;          // points
constexpr int kLabelWeight = 40;       // another label below is far worse than a line
constexpr double kOutsideCost = 60.0;  // a cell beyond the border
constexpr double kAwayPoints = 7.0;    // beyond this gap a leader line is drawn

}  // namespace

LabelPlacer::LabelPlacer(const PageRect& area) : area_(area) {
  columns_ = std::max(1, static_cast<int>(std::ceil(area.size.x() / kCell)));
  rows_ = std::max(1, static_cast<int>(std::ceil(area.size.y() / kCell)));
  ink_.assign(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_), 0);
}

int LabelPlacer::column(double x) const {
  return static_cast<int>(std::floor(std::clamp((x - area_.min.x()) / kCell, -1e6, 1e6)));
}

int LabelPlacer::row(double y) const {
  return static_cast<int>(std::floor(std::clamp((y - area_.min.y()) / kCell, -1e6, 1e6)));
}

void LabelPlacer::add(int column, int row, int weight) {
  if (column < 0 || row < 0 || column >= columns_ || row >= rows_) return;
  auto& cell = ink_[static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) +
                    static_cast<std::size_t>(column)];
  cell = static_cast<std::uint16_t>(std::min(1000, cell + weight));
}

void LabelPlacer::occupy(const PathPoints& path, double width) {
  const int beside = static_cast<int>(std::min(0.5 * width / kCell + 0.4, 10.0));
  for (std::size_t i = 0; i < path.count(); ++i) {
    const std::span<const Vector2d> part = path.part(i);
    for (std::size_t k = 0; k + 1 < part.size(); ++k) {
      const Vector2d step = part[k + 1] - part[k];
      const int count = static_cast<int>(std::min(step.norm() / kCell, 1e5)) + 1;
      for (int s = 0; s < count; ++s) {
        const Vector2d p = part[k] + step * (static_cast<double>(s) / count);
        for (int dc = -beside; dc <= beside; ++dc) {
          for (int dr = -beside; dr <= beside; ++dr) add(column(p.x()) + dc, row(p.y()) + dr, 1);
        }
      }
    }
  }
}

void LabelPlacer::occupy(const PageRect& rect, int weight) {
  for (int r = std::max(0, row(rect.min.y())); r <= std::min(rows_ - 1, row(rect.max().y())); ++r) {
    const int last = std::min(columns_ - 1, column(rect.max().x()));
    for (int c = std::max(0, column(rect.min.x())); c <= last; ++c) add(c, r, weight);
  }
}

double LabelPlacer::cost(const PageRect& box) const {
  double sum = 0.0;
  for (int r = row(box.min.y()); r <= row(box.max().y()); ++r) {
    for (int c = column(box.min.x()); c <= column(box.max().x()); ++c) {
      const bool inside = c >= 0 && r >= 0 && c < columns_ && r < rows_;
      sum += !inside ? kOutsideCost
                     : ink_[static_cast<std::size_t>(r) * static_cast<std::size_t>(columns_) +
                            static_cast<std::size_t>(c)];
    }
  }
  return sum;
}

LabelPlacer::Spot LabelPlacer::place(const Vector2d& anchor, double clearance,
                                     const Vector2d& size) {
  constexpr int kDirections = 16;
  Spot best;
  double best_cost = std::numeric_limits<double>::infinity();
  for (const double gap : {0.0, 3.0, 8.0, 14.0}) {
    for (int i = 0; i < kDirections; ++i) {
      // From the upper right, where readers expect a label, and alternating around from there.
      const int turn = (i % 2 == 0 ? 1 : -1) * ((i + 1) / 2);
      const Vector2d toward = unit_vector(-0.25 * kPi + turn * kTwoPi / kDirections);
      const Vector2d center = anchor + (clearance + gap) * toward + 0.5 * toward.cwiseProduct(size);
      const PageRect box{center - 0.5 * size, size};
      const double ink = cost(box.padded(0.8));
      const double total = ink + 0.35 * gap + 0.05 * i;
      if (total >= best_cost) continue;
      best_cost = total;
      best = {box, ink > 0.0, gap > kAwayPoints};
    }
  }
  occupy(best.box.padded(0.8), kLabelWeight);
  return best;
}

}  // namespace adit
