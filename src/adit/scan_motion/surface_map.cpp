#include "adit/scan_motion/surface_map.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <utility>

namespace adit {
namespace {

constexpr float kSameFacing = 0.7F;  // cosine of 45 degrees

std::int64_t cell_key(std::int32_t i, std::int32_t j) {
  return (static_cast<std::int64_t>(i) << 32) | static_cast<std::uint32_t>(j);
}

std::int32_t cell_of(float x, double side) {
  return static_cast<std::int32_t>(std::floor(static_cast<double>(x) / side));
}

/// Fibonacci hashing: the high bits of a product with 2^64 over the golden ratio.
std::uint64_t hash_of(std::int64_t key) {
  return (static_cast<std::uint64_t>(key) * 0x9E3779B97F4A7C15ULL) >> 20;
}

/// In which of eight directions a normal points; none counts as a direction of its own.
std::int32_t facing(const SurfacePoint& p) {
  if (!p.has_normal()) return 8;
  const float ax = std::abs(p.normal.x());
  const float ay = std::abs(p.normal.y());
  return (p.normal.x() < 0.0F ? 1 : 0) + (p.normal.y() < 0.0F ? 2 : 0) + (ax < ay ? 4 : 0);
}

}  // namespace

void SurfaceMap::clear() {
  raw_.clear();
  points_.clear();
  table_.clear();
}

void SurfaceMap::add(std::span<const SurfacePoint> points, const RigidTransform& map_from_points) {
  for (const SurfacePoint& p : points) raw_.push_back(carry(map_from_points, p));
}

void SurfaceMap::index() {
  merge();
  raw_ = {};
  bucket();
}

void SurfaceMap::merge() {
  struct Tagged {
    std::int64_t key;
    std::int32_t facing;
    std::uint32_t row;
    auto operator<=>(const Tagged&) const = default;  // NOLINT(modernize-use-nullptr): in its code
  };
  std::vector<Tagged> order;
  order.reserve(raw_.size());
  for (std::uint32_t row = 0; row < raw_.size(); ++row) {
    const SurfacePoint& p = raw_[row];
    if (!p.has_normal()) continue;
    order.push_back(
        {cell_key(cell_of(p.point.x(), merge_m_), cell_of(p.point.y(), merge_m_)), facing(p), row});
  }
  std::sort(order.begin(), order.end());
  points_.clear();
  for (std::size_t begin = 0, end = 0; begin < order.size(); begin = end) {
    SurfacePoint sum;
    while (end < order.size() && order[end].key == order[begin].key &&
           order[end].facing == order[begin].facing) {
      sum.point += raw_[order[end].row].point;
      sum.normal += raw_[order[end].row].normal;
      ++end;
    }
    points_.push_back({sum.point / static_cast<float>(end - begin), sum.normal.normalized()});
  }
}

void SurfaceMap::bucket() {
  std::vector<std::pair<std::int64_t, std::uint32_t>> order;
  order.reserve(points_.size());
  for (std::uint32_t row = 0; row < points_.size(); ++row) {
    const Eigen::Vector2f& p = points_[row].point;
    order.emplace_back(cell_key(cell_of(p.x(), reach_m_), cell_of(p.y(), reach_m_)), row);
  }
  std::sort(order.begin(), order.end());
  std::vector<SurfacePoint> sorted;
  sorted.reserve(points_.size());
  for (const auto& [key, row] : order) sorted.push_back(points_[row]);
  points_ = std::move(sorted);
  std::size_t cells = 0;
  for (std::size_t i = 0; i < order.size(); ++i) {
    cells += i == 0 || order[i].first != order[i - 1].first;
  }
  table_.assign(std::bit_ceil(2 * cells + 2), Cell{});
  mask_ = table_.size() - 1;
  for (std::size_t begin = 0, end = 0; begin < order.size(); begin = end) {
    while (end < order.size() && order[end].first == order[begin].first) ++end;
    std::uint64_t slot = hash_of(order[begin].first) & mask_;
    while (table_[slot].key != kEmpty) slot = (slot + 1) & mask_;
    table_[slot] = {order[begin].first, static_cast<std::uint32_t>(begin),
                    static_cast<std::uint32_t>(end)};
  }
}

const SurfaceMap::Cell* SurfaceMap::find(std::int64_t key) const {
  std::uint64_t slot = hash_of(key) & mask_;
  while (table_[slot].key != kEmpty) {
    if (table_[slot].key == key) return &table_[slot];
    slot = (slot + 1) & mask_;
  }
  return nullptr;
}

const SurfacePoint* SurfaceMap::nearest(const Eigen::Vector2f& point, const Eigen::Vector2f& normal,
                                        float reach) const {
  if (table_.empty()) return nullptr;
  const SurfacePoint* best = nullptr;
  float best2 = reach * reach;
  const std::int32_t i0 = cell_of(point.x() - reach, reach_m_);
  const std::int32_t i1 = cell_of(point.x() + reach, reach_m_);
  const std::int32_t j0 = cell_of(point.y() - reach, reach_m_);
  const std::int32_t j1 = cell_of(point.y() + reach, reach_m_);
  for (std::int32_t i = i0; i <= i1; ++i) {
    for (std::int32_t j = j0; j <= j1; ++j) {
      const Cell* cell = find(cell_key(i, j));
      if (cell == nullptr) continue;
      for (std::uint32_t k = cell->begin; k < cell->end; ++k) {
        const SurfacePoint& candidate = points_[k];
        const float d2 = (candidate.point - point).squaredNorm();
        if (d2 >= best2 || candidate.normal.dot(normal) < kSameFacing) continue;
        best = &candidate;
        best2 = d2;
      }
    }
  }
  return best;
}

}  // namespace adit
