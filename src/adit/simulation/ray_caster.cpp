#include "adit/simulation/ray_caster.hpp"

#include <algorithm>
#include <cmath>

namespace adit {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kTouch = 1e-9;   // m: ends reach this much further; nearer walls are stood upon
constexpr double kMargin = 1e-6;  // m: a segment is entered in each cell that it passes this near

/// Where a ray meets one axis' grid lines, and in steps of how many metres.
struct AxisWalk {
  int step = 0;
  double next = kInfinity;  // metres along the ray to the next grid line
  double every = kInfinity;
};

AxisWalk walk_axis(double origin, double direction, double corner, double cell_m, int cell) {
  if (direction == 0.0) return {};
  const int ahead = direction > 0.0 ? 1 : 0;
  const double line = corner + (cell + ahead) * cell_m;
  return {direction > 0.0 ? 1 : -1, (line - origin) / direction, cell_m / std::abs(direction)};
}

/// Shrinks [enter, leave] to where the ray lies between `low` and `high` on one axis.
void clip(double origin, double direction, double low, double high, double& enter, double& leave) {
  if (direction == 0.0) {
    if (origin < low || origin > high) leave = -kInfinity;
    return;
  }
  const double a = (low - origin) / direction;
  const double b = (high - origin) / direction;
  enter = std::max(enter, std::min(a, b));
  leave = std::min(leave, std::max(a, b));
}

}  // namespace

double cast_ray(const Segment& segment, const Vector2d& origin, const Vector2d& direction) {
  const Vector2d along = segment.b - segment.a;
  const Vector2d to_a = segment.a - origin;
  const double parallel = cross(direction, along);
  if (parallel == 0.0) return kInfinity;
  const double range = cross(to_a, along) / parallel;
  const double length = along.norm();
  const double from_a = length * (cross(to_a, direction) / parallel);
  const bool hit = range > kTouch && from_a >= -kTouch && from_a <= length + kTouch;
  return hit ? range : kInfinity;
}

double cast_ray(std::span<const Segment> segments, const Vector2d& origin,
                const Vector2d& direction, double max_range) {
  double nearest = kInfinity;
  for (const Segment& segment : segments) {
    nearest = std::min(nearest, cast_ray(segment, origin, direction));
  }
  return nearest <= max_range ? nearest : kInfinity;
}

RayCaster::RayCaster(std::span<const Segment> segments) {
  std::copy_if(segments.begin(), segments.end(), std::back_inserter(segments_),
               [](const Segment& s) { return s.is_finite(); });
  if (segments_.empty()) return;
  lay_grid();
  const std::size_t cells = static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_);
  first_in_cell_.assign(cells + 1, 0);
  for (const Segment& s : segments_) {
    visit_cells(s, [&](std::size_t cell) { ++first_in_cell_[cell + 1]; });
  }
  for (std::size_t c = 0; c < cells; ++c) first_in_cell_[c + 1] += first_in_cell_[c];
  entries_.resize(static_cast<std::size_t>(first_in_cell_.back()));
  std::vector<int> fill(first_in_cell_.begin(), first_in_cell_.end() - 1);
  for (std::size_t i = 0; i < segments_.size(); ++i) {
    visit_cells(segments_[i], [&](std::size_t cell) {
      entries_[static_cast<std::size_t>(fill[cell]++)] = static_cast<int>(i);
    });
  }
}

void RayCaster::lay_grid() {
  Vector2d low = segments_.front().a;
  Vector2d high = low;
  for (const Segment& s : segments_) {
    low = low.cwiseMin(s.a).cwiseMin(s.b);
    high = high.cwiseMax(s.a).cwiseMax(s.b);
  }
  corner_ = low.array() - 2.0 * kMargin;
  const Vector2d size = (high - corner_).array() + 2.0 * kMargin;
  // About two cells a segment: then a cell holds few segments and the grid costs no more than they.
  const double cells = std::max(64.0, 2.0 * static_cast<double>(segments_.size()));
  cell_m_ = std::max(std::sqrt(size.x() * size.y() / cells), size.maxCoeff() / cells);
  columns_ = static_cast<int>(size.x() / cell_m_) + 1;
  rows_ = static_cast<int>(size.y() / cell_m_) + 1;
}

int RayCaster::column(double x) const {
  return std::clamp(static_cast<int>((x - corner_.x()) / cell_m_), 0, columns_ - 1);
}

int RayCaster::row(double y) const {
  return std::clamp(static_cast<int>((y - corner_.y()) / cell_m_), 0, rows_ - 1);
}

template <class Visit>
void RayCaster::visit_cells(const Segment& segment, Visit&& visit) const {
  const Vector2d along = segment.b - segment.a;
  const auto [low_y, high_y] = std::minmax(segment.a.y(), segment.b.y());
  for (int iy = row(low_y - kMargin); iy <= row(high_y + kMargin); ++iy) {
    // The part of the segment inside this row of cells, as fractions of its length.
    double enter = 0.0;
    double leave = 1.0;
    const double floor_y = corner_.y() + iy * cell_m_;
    clip(segment.a.y(), along.y(), floor_y - kMargin, floor_y + cell_m_ + kMargin, enter, leave);
    if (leave < enter) continue;
    const double x0 = segment.a.x() + enter * along.x();
    const double x1 = segment.a.x() + leave * along.x();
    const int last = column(std::max(x0, x1) + kMargin);
    for (int ix = column(std::min(x0, x1) - kMargin); ix <= last; ++ix) {
      visit(static_cast<std::size_t>(iy) * static_cast<std::size_t>(columns_) +
            static_cast<std::size_t>(ix));
    }
  }
}

double RayCaster::range_in_cell(const Cell& cell, const Vector2d& origin,
                                const Vector2d& direction) const {
  const std::size_t index = static_cast<std::size_t>(cell.y) * static_cast<std::size_t>(columns_) +
                            static_cast<std::size_t>(cell.x);
  double nearest = kInfinity;
  for (int e = first_in_cell_[index]; e < first_in_cell_[index + 1]; ++e) {
    const int segment = entries_[static_cast<std::size_t>(e)];
    nearest = std::min(nearest,
                       cast_ray(segments_[static_cast<std::size_t>(segment)], origin, direction));
  }
  return nearest;
}

double RayCaster::range(const Vector2d& origin, const Vector2d& direction, double max_range) const {
  if (segments_.empty()) return kInfinity;
  double enter = 0.0;
  double leave = max_range;
  clip(origin.x(), direction.x(), corner_.x(), corner_.x() + columns_ * cell_m_, enter, leave);
  clip(origin.y(), direction.y(), corner_.y(), corner_.y() + rows_ * cell_m_, enter, leave);
  if (!(enter <= leave)) return kInfinity;

  const Vector2d start = origin + enter * direction;
  Cell cell{column(start.x()), row(start.y())};
  AxisWalk x = walk_axis(origin.x(), direction.x(), corner_.x(), cell_m_, cell.x);
  AxisWalk y = walk_axis(origin.y(), direction.y(), corner_.y(), cell_m_, cell.y);
  double nearest = kInfinity;
  // A hit behind this cell's far side may be hidden by a wall of a cell still to come.
  for (;;) {
    nearest = std::min(nearest, range_in_cell(cell, origin, direction));
    const double far_side = std::min(x.next, y.next);
    if (nearest <= far_side || far_side > max_range) break;
    AxisWalk& crossed = x.next <= y.next ? x : y;
    int& index = x.next <= y.next ? cell.x : cell.y;
    const int count = &crossed == &x ? columns_ : rows_;
    index += crossed.step;
    crossed.next += crossed.every;
    if (index < 0 || index >= count) break;
  }
  return nearest <= max_range ? nearest : kInfinity;
}

}  // namespace adit
