#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include "adit/geometry/pose2.hpp"

namespace adit {

/// A cell of a grid that covers the plane.
struct GridCell {
  std::int32_t x = 0;
  std::int32_t y = 0;
};

/// A sparse grid of square cells: tiles are made where something is put, so that memory grows with
/// the walls and the space between them and not with the mine's extent.
template <class Value>
class TileGrid {
 public:
  explicit TileGrid(double cell_m) : cell_m_(cell_m) {}

  double cell_m() const { return cell_m_; }
  GridCell cell_at(const Vector2d& p) const {
    return {static_cast<std::int32_t>(std::floor(p.x() / cell_m_)),
            static_cast<std::int32_t>(std::floor(p.y() / cell_m_))};
  }

  /// The cell's value, which is made if need be.
  Value& at(const GridCell& cell) {
    const std::uint64_t key = tile_key(cell);
    if (!found_ || key != last_key_) look_up(key, true);
    return tiles_[last_tile_][place_in_tile(cell)];
  }

  /// The cell's value, or null where nothing near was ever put.
  Value* find(const GridCell& cell) {
    const std::uint64_t key = tile_key(cell);
    if (key != last_key_ || !looked_up_) look_up(key, false);
    return found_ ? &tiles_[last_tile_][place_in_tile(cell)] : nullptr;
  }

 private:
  static constexpr int kShift = 5;
  static constexpr std::int32_t kSide = 1 << kShift;
  using Tile = std::array<Value, static_cast<std::size_t>(kSide* kSide)>;

  static std::uint64_t tile_key(const GridCell& cell) {
    return (static_cast<std::uint64_t>(static_cast<std::uint32_t>(cell.x >> kShift)) << 32) |
           static_cast<std::uint32_t>(cell.y >> kShift);
  }
  static std::size_t place_in_tile(const GridCell& cell) {
    return static_cast<std::size_t>(((cell.y & (kSide - 1)) << kShift) | (cell.x & (kSide - 1)));
  }
  void look_up(std::uint64_t key, bool make) {
    auto entry = tile_of_.find(key);
    if (entry == tile_of_.end() && make) {
      entry = tile_of_.emplace(key, tiles_.size()).first;
      tiles_.emplace_back();
    }
    found_ = entry != tile_of_.end();
    if (found_) last_tile_ = entry->second;
    last_key_ = key;
    looked_up_ = true;
  }

  double cell_m_;
  std::vector<Tile> tiles_;
  std::unordered_map<std::uint64_t, std::size_t> tile_of_;
  // Neighbouring cells mostly lie in one tile: the last one found is kept.
  std::uint64_t last_key_ = 0;
  std::size_t last_tile_ = 0;
  bool found_ = false;
  bool looked_up_ = false;
};

/// Calls `visit(cell)` for the cells from `from` to `to` in order (Amanatides & Woo 1987).
template <class Visit>
void walk_cells(const Vector2d& from, const Vector2d& to, double cell_m, const Visit& visit) {
  const Vector2d way = to - from;
  const double length = way.norm();
  std::array<std::int32_t, 2> at{};
  std::array<std::int32_t, 2> step{};
  std::array<double, 2> next{};
  std::array<double, 2> every{};
  int left = 0;
  for (int axis = 0; axis < 2; ++axis) {
    const auto i = static_cast<std::size_t>(axis);
    at[i] = static_cast<std::int32_t>(std::floor(from[axis] / cell_m));
    const auto last = static_cast<std::int32_t>(std::floor(to[axis] / cell_m));
    left += std::abs(last - at[i]);
    step[i] = last >= at[i] ? 1 : -1;
    const double slope = std::abs(way[axis]) / std::max(length, 1e-12);
    const double border = cell_m * (at[i] + (step[i] > 0 ? 1 : 0));
    every[i] = slope > 0.0 ? cell_m / slope : 1e300;
    next[i] = slope > 0.0 ? std::abs(border - from[axis]) / slope : 1e300;
  }
  visit(GridCell{at[0], at[1]});
  for (; left > 0; --left) {
    const std::size_t axis = next[0] <= next[1] ? 0 : 1;
    at[axis] += step[axis];
    next[axis] += every[axis];
    visit(GridCell{at[0], at[1]});
  }
}

}  // namespace adit
