#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "adit/map/line_map.hpp"

namespace adit {

/// The wall nearest to any point, if there is one near, in a few nanoseconds: squares of half a
/// metre that know the wall nearest to their middle and how far that is. Memory grows with the
/// length of the walls.
class WallField {
 public:
  /// A wall, relative to the field's origin (m). In single precision: a millimetre at ten
  /// kilometres.
  struct Line {
    float x = 0.0F;
    float y = 0.0F;
    float along_x = 1.0F;  ///< unit vector
    float along_y = 0.0F;
    float length = 0.0F;
  };

  /// Beyond a wall's end it is still met by this (m).
  static constexpr float kBeyondEnd = 0.25F;

  WallField() = default;
  explicit WallField(const LineMap& map);

  const Vector2d& origin() const { return origin_; }

  /// The number of the wall nearest to the middle of the point's square; `kNone` where all are
  /// farther than about a metre and a half. Relative to the origin. Without a branch that depends
  /// on what it finds, so that many points are looked up at once.
  std::int32_t nearest(float x, float y) const { return look_up(cells_, x, y, kNone); }
  static constexpr std::int32_t kNone = 0;

  /// How far the middle of the point's square is from that wall, in steps of `kOffStep`; no more
  /// than the last code, and that where none is near. A fourth of the memory of `nearest` to read.
  std::uint8_t off_code(float x, float y) const { return look_up(offs_, x, y, kFarOff); }
  static constexpr float kOffStep = 1.0F / 128.0F;  // m
  static constexpr std::uint8_t kFarOff = 255;

  /// A wall by its number; that of `kNone` is met nowhere.
  const Line& line(std::int32_t number) const { return lines_[static_cast<std::size_t>(number)]; }

  /// A point and the wall nearest to it.
  struct Meeting {
    int wall = 0;
    double off = 0.0;  ///< how far from it, along `normal` (m)
    Vector2d normal = Vector2d::UnitX();
  };

  /// The wall that a point of the map may lie on; none beyond the ends of the nearest one.
  std::optional<Meeting> meet(const Vector2d& point) const;

  /// Whether a wall stands in the way from one point to another, relative to the origin, and the
  /// latter lies at least so far behind it. Walls nearest to no square are overlooked.
  bool is_between(float from_x, float from_y, float to_x, float to_y, float behind_m) const;

  /// Bytes that it holds.
  std::size_t memory() const;

 private:
  static constexpr float kPerMetre = 2.0F;
  static constexpr std::int32_t kTileBits = 4;
  static constexpr std::int32_t kTile = 1 << kTileBits;
  using Tile = std::array<std::int32_t, kTile * kTile>;
  using TileOffs = std::array<std::uint8_t, kTile * kTile>;

  /// What squares hold at a point; `outside` off the plan.
  template <class Squares, class Value>
  Value look_up(const Squares& squares, float x, float y, Value outside) const {
    if (!(x >= 0.0F && y >= 0.0F && x < width_ && y < height_)) return outside;
    const auto column = static_cast<std::int32_t>(x * kPerMetre);
    const auto row = static_cast<std::int32_t>(y * kPerMetre);
    const std::int32_t tile = tiles_[tile_of(column, row)];
    return squares[static_cast<std::size_t>(tile)][cell_of(column, row)];
  }

  std::size_t tile_of(std::int32_t column, std::int32_t row) const {
    return static_cast<std::size_t>(row >> kTileBits) * static_cast<std::size_t>(tile_columns_) +
           static_cast<std::size_t>(column >> kTileBits);
  }
  static std::size_t cell_of(std::int32_t column, std::int32_t row) {
    return static_cast<std::size_t>(((row & (kTile - 1)) << kTileBits) | (column & (kTile - 1)));
  }
  void lay_out_tiles();
  void offer(std::int32_t column, std::int32_t row, std::int32_t line);

  Vector2d origin_ = Vector2d::Zero();
  float width_ = 0.0F;  // m
  float height_ = 0.0F;
  std::int32_t tile_columns_ = 0;
  std::vector<std::int32_t> tiles_;  // the first where no wall is near
  std::vector<Tile> cells_;
  std::vector<TileOffs> offs_;
  // One after those of the map; on the first nothing lies.
  std::vector<Line> lines_{{0.0F, 0.0F, 1.0F, 0.0F, -1e9F}};
};

}  // namespace adit
