#include "adit/map/vertex_grid.hpp"

#include <algorithm>
#include <bit>

namespace adit {
namespace {

// Large beside the search radius, so that most searches look into one cell; at most some hundred
// points that keep the tolerance between them fit into one.
constexpr double kCellPerTolerance = 16.0;

// std::floor is a call into the library on baseline x86-64, and this is the innermost loop.
std::int64_t floor_to_int(double value) {
  const auto truncated = static_cast<std::int64_t>(value);
  return truncated - (value < static_cast<double>(truncated) ? 1 : 0);
}

}  // namespace

VertexGrid::VertexGrid(double tolerance, std::size_t expected_count)
    : cells_per_metre_(1.0 / (kCellPerTolerance * tolerance)),
      first_(std::bit_ceil(std::max<std::size_t>(expected_count, 16)), -1) {
  positions_.reserve(expected_count);
  homes_.reserve(expected_count);
  next_.reserve(expected_count);
}

VertexGrid::Cell VertexGrid::cell_of(double x, double y) const {
  return {floor_to_int(x * cells_per_metre_), floor_to_int(y * cells_per_metre_)};
}

std::size_t VertexGrid::bucket_of(Cell cell) const {
  // Cells that share a bucket cost a distance test and nothing else.
  std::uint64_t hash = static_cast<std::uint64_t>(cell.x) * 0x9E3779B97F4A7C15U;
  hash ^= static_cast<std::uint64_t>(cell.y) * 0xC2B2AE3D27D4EB4FU;
  hash ^= hash >> 32;
  hash *= 0x9E3779B97F4A7C15U;
  hash ^= hash >> 29;
  return static_cast<std::size_t>(hash) & (first_.size() - 1);
}

int VertexGrid::add(const Vector2d& point) {
  if (positions_.size() >= first_.size()) grow();
  const int vertex = static_cast<int>(positions_.size());
  positions_.push_back(point);
  homes_.push_back(point);
  next_.push_back(-1);
  link(vertex);
  return vertex;
}

void VertexGrid::link(int vertex) {
  const auto v = static_cast<std::size_t>(vertex);
  const std::size_t bucket = bucket_of(cell_of(homes_[v].x(), homes_[v].y()));
  next_[v] = first_[bucket];
  first_[bucket] = vertex;
}

void VertexGrid::grow() {
  first_.assign(2 * first_.size(), -1);
  for (std::size_t v = 0; v < positions_.size(); ++v) link(static_cast<int>(v));
}

void VertexGrid::move(int vertex, const Vector2d& to) {
  const auto v = static_cast<std::size_t>(vertex);
  positions_[v] = to;
  farthest_move_ = std::max(farthest_move_, (to - homes_[v]).norm());
}

int VertexGrid::nearest(const Vector2d& center, double radius, int except) const {
  const double reach = radius + farthest_move_;
  const Cell low = cell_of(center.x() - reach, center.y() - reach);
  const Cell high = cell_of(center.x() + reach, center.y() + reach);
  int best = -1;
  double best_squared = radius * radius;
  for (std::int64_t y = low.y; y <= high.y; ++y) {
    for (std::int64_t x = low.x; x <= high.x; ++x) {
      for (int v = first_[bucket_of({x, y})]; v >= 0; v = next_[static_cast<std::size_t>(v)]) {
        const double squared = (position(v) - center).squaredNorm();
        if (v == except || squared > best_squared) continue;
        if (squared == best_squared && best >= 0 && best < v) continue;
        best = v;
        best_squared = squared;
      }
    }
  }
  return best;
}

}  // namespace adit
