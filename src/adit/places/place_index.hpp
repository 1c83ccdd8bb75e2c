#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "adit/geometry/pose2.hpp"
#include "adit/map/line_map.hpp"
#include "adit/places/corner_index.hpp"
#include "adit/places/options.hpp"
#include "adit/places/range_code.hpp"
#include "adit/places/wall_field.hpp"

namespace adit {

/// What an index is made of. Places follow each other row by row, and column by column within a
/// row.
struct PlaceArrays {
  struct Cell {
    std::int32_t column = 0;
    std::int32_t row = 0;
  };
  double origin_x = 0.0;  // m
  double origin_y = 0.0;
  double pitch_m = 1.0;
  std::vector<Cell> cells;
  std::vector<RangeBands> codes;
};

/// What is in sight from the places of a plan where a scanner may stand.
///
/// Places lie on a square lattice; each keeps its ranges as two bytes a bearing bin (map axes) and
/// sorted, 168 bytes in all. Nobody knows the inside of a plan from its outside: places within
/// rock are in it as well. The same with any number of threads.
class PlaceIndex {
 public:
  PlaceIndex() = default;
  /// Of arrays that were made of this map.
  PlaceIndex(const LineMap& map, PlaceArrays arrays);
  static PlaceIndex build(const LineMap& map, const PlaceIndexOptions& options = {},
                          int threads = 1);

  std::size_t size() const { return arrays_.cells.size(); }
  bool empty() const { return arrays_.cells.empty(); }
  double pitch_m() const { return arrays_.pitch_m; }
  const PlaceArrays& arrays() const { return arrays_; }
  /// Bytes that it holds.
  std::size_t memory() const;

  Vector2d position(std::size_t place) const {
    const PlaceArrays::Cell& cell = arrays_.cells[place];
    return Vector2d(arrays_.origin_x, arrays_.origin_y) +
           arrays_.pitch_m * Vector2d(cell.column, cell.row);
  }
  const RangeBands& codes(std::size_t place) const { return arrays_.codes[place]; }

  /// The ranges of so many places, sorted: what does not depend on the heading. The same rank of
  /// all places lies together.
  static constexpr std::size_t kBlock = 64;
  static constexpr std::size_t kRanks = 16;
  struct SortedRanges {
    std::array<std::array<std::uint8_t, kBlock>, kRanks> longest{};   ///< rank 0: the longest
    std::array<std::array<std::uint8_t, kBlock>, kRanks> shortest{};  ///< rank 0: the shortest
  };
  /// Block i is of the places from kBlock * i on.
  std::span<const SortedRanges> sorted_ranges() const { return sorted_; }

  const WallField& walls() const { return walls_; }
  const CornerIndex& corners() const { return corners_; }

 private:
  struct Row {
    std::vector<PlaceArrays::Cell> cells;
    std::vector<RangeBands> codes;
  };
  class RowBuilder;
  void sort_ranges();

  PlaceArrays arrays_;
  std::vector<SortedRanges> sorted_;
  WallField walls_;
  CornerIndex corners_;
};

}  // namespace adit
