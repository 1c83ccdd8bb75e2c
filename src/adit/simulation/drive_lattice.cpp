#include "adit/simulation/drive_lattice.hpp"

#include <algorithm>
#include <cmath>

namespace adit {
namespace {

constexpr int kSamples = 5;  // in a square, on each axis
constexpr int kRim = 2;      // squares around the plan
constexpr double kMostSamples = 2e7;
constexpr double kSameWall = 0.3;  // m: crossings so near are of one wall, drawn twice

/// Distances to the nearest wall on a square grid.
class RoomGrid {
 public:
  RoomGrid(const Vector2d& first, double step, int columns, int rows, double ample)
      : first_(first), step_(step), columns_(columns), rows_(rows), ample_(ample) {
    squared_.assign(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows),
                    ample * ample);
  }

  void add(const Segment& wall) {
    const Segment s = wall.a.y() <= wall.b.y() ? wall : Segment{wall.b, wall.a};
    const int last = index((s.b.y() + ample_ - first_.y()) / step_, rows_);
    for (int r = index((s.a.y() - ample_ - first_.y()) / step_, rows_); r <= last; ++r) {
      add_to_row(s, r);
    }
  }

  Vector2d at(int column, int row) const { return first_ + step_ * Vector2d(column, row); }
  double room(int column, int row) const {
    return std::sqrt(squared_[static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) +
                              static_cast<std::size_t>(column)]);
  }

 private:
  static int index(double value, int count) {
    return static_cast<int>(std::clamp(std::floor(value), 0.0, count - 1.0));
  }

  /// To what is in a row and near enough to the part of the wall that is near the row.
  void add_to_row(const Segment& s, int row) {
    const Vector2d along = s.b - s.a;
    const double length = along.squaredNorm();
    const double y = first_.y() + row * step_;
    double x1 = s.a.x();
    double x2 = s.b.x();
    if (along.y() > 1e-9) {
      const auto part = [&](double to) { return std::clamp((to - s.a.y()) / along.y(), 0.0, 1.0); };
      x1 = s.a.x() + part(y - ample_) * along.x();
      x2 = s.a.x() + part(y + ample_) * along.x();
    }
    const int last = index((std::max(x1, x2) + ample_ - first_.x()) / step_ + 1.0, columns_);
    double* rooms = &squared_[static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_)];
    for (int c = index((std::min(x1, x2) - ample_ - first_.x()) / step_, columns_); c <= last;
         ++c) {
      const Vector2d to = Vector2d(first_.x() + c * step_, y) - s.a;
      const double part = length > 0.0 ? std::clamp(to.dot(along) / length, 0.0, 1.0) : 0.0;
      rooms[c] = std::min(rooms[c], (to - part * along).squaredNorm());
    }
  }

  Vector2d first_;
  double step_;
  int columns_;
  int rows_;
  double ample_;
  std::vector<double> squared_;
};

/// Where lines of equal distance across an axis (0: columns, 1: rows) cross walls.
class Scanlines {
 public:
  Scanlines(std::span<const Segment> walls, int axis, double first, double step, int count)
      : axis_(axis), first_(first), step_(step), lines_(static_cast<std::size_t>(count)) {
    for (const Segment& wall : walls) add(wall);
    for (std::vector<double>& line : lines_) {
      std::sort(line.begin(), line.end());
      const auto same = [](double a, double b) { return b - a < kSameWall; };
      line.erase(std::unique(line.begin(), line.end(), same), line.end());
    }
  }

  int vote(const Vector2d& place, int line) const {
    const std::vector<double>& crossings = lines_[static_cast<std::size_t>(line)];
    const auto here = std::upper_bound(crossings.begin(), crossings.end(), place[1 - axis_]);
    const bool before = (here - crossings.begin()) % 2 != 0;
    const bool after = (crossings.end() - here) % 2 != 0;
    return before != after ? 0 : before ? 1 : -1;
  }

 private:
  void add(const Segment& s) {
    const double low = std::min(s.a[axis_], s.b[axis_]);
    const double high = std::max(s.a[axis_], s.b[axis_]);
    for (double line = std::max(0.0, std::ceil((low - first_) / step_));; line += 1.0) {
      const double at = first_ + step_ * line;
      if (!(at < high) || line >= static_cast<double>(lines_.size())) return;
      const double part = (at - s.a[axis_]) / (s.b[axis_] - s.a[axis_]);
      lines_[static_cast<std::size_t>(line)].push_back(s.a[1 - axis_] +
                                                       part * (s.b[1 - axis_] - s.a[1 - axis_]));
    }
  }

  int axis_;
  double first_;
  double step_;
  std::vector<std::vector<double>> lines_;
};

/// The sample of a square with the most room; the middle one where others have no more.
DriveLattice::Spot roomiest(const RoomGrid& grid, const Scanlines& columns, const Scanlines& rows,
                            int column, int row) {
  int best_x = column * kSamples + kSamples / 2;
  int best_y = row * kSamples + kSamples / 2;
  double best = grid.room(best_x, best_y);
  for (int y = row * kSamples; y < (row + 1) * kSamples; ++y) {
    for (int x = column * kSamples; x < (column + 1) * kSamples; ++x) {
      if (grid.room(x, y) <= best) continue;
      best = grid.room(x, y);
      best_x = x;
      best_y = y;
    }
  }
  const Vector2d position = grid.at(best_x, best_y);
  return {position, best, columns.vote(position, best_x) + rows.vote(position, best_y)};
}

}  // namespace

DriveLattice lay_lattice(const WallBuckets& walls, double pitch_m, double ample_m) {
  DriveLattice lattice;
  if (walls.walls().empty()) return lattice;
  const Vector2d size = walls.far_corner() - walls.corner();
  const auto samples = [&](double pitch) {
    return (size.x() / pitch + 5.0) * (size.y() / pitch + 5.0) * kSamples * kSamples;
  };
  while (samples(pitch_m) > kMostSamples) pitch_m *= 1.1;
  lattice.pitch_m = pitch_m;
  lattice.corner = walls.corner() - Vector2d::Constant(kRim * pitch_m);
  lattice.columns = static_cast<int>(size.x() / pitch_m) + 1 + 2 * kRim;
  lattice.rows = static_cast<int>(size.y() / pitch_m) + 1 + 2 * kRim;
  const double step = pitch_m / kSamples;
  const Vector2d first = lattice.corner + Vector2d::Constant(0.5 * step);
  const int across = lattice.columns * kSamples;
  const int up = lattice.rows * kSamples;
  RoomGrid grid(first, step, across, up, ample_m);
  for (const Segment& wall : walls.walls()) grid.add(wall);
  const Scanlines columns(walls.walls(), 0, first.x(), step, across);
  const Scanlines rows(walls.walls(), 1, first.y(), step, up);
  for (int row = 0; row < lattice.rows; ++row) {
    for (int column = 0; column < lattice.columns; ++column) {
      lattice.spots.push_back(roomiest(grid, columns, rows, column, row));
    }
  }
  return lattice;
}

}  // namespace adit
