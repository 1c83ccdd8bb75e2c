#pragma once

#include <array>
#include <memory>
#include <span>
#include <vector>

#include "adit/map/line_map.hpp"

namespace adit {

/// A wall as an unbounded line with its extent: what a beam is tried against.
struct WallLine {
  Vector2d foot = Vector2d::Zero();    ///< where it begins (map axes)
  Vector2d along = Vector2d::Zero();   ///< unit vector
  Vector2d normal = Vector2d::Zero();  ///< unit vector, left of `along`
  double length = 0.0;
  int wall = -1;
};

WallLine line_of(const LineMap& map, int wall);

/// The walls close to a wall, kept for those that were asked for last.
///
/// Plans hold walls twice, a hand's breadth apart, or end a wall too early; what a beam met may be
/// the neighbour of the wall that the plan puts in its way. Fixed in size: allocates nothing while
/// the vehicle drives on.
class WallNeighbours {
 public:
  /// Before neighbours are asked for: the map, which must stay alive meanwhile, and the reach (m).
  /// What was kept of another map or for another reach is forgotten.
  void reset(const LineMap& map, double reach);

  /// The nearest neighbours of a wall, nearest first, none farther than the reach.
  std::span<const WallLine> of(int wall);

 private:
  static constexpr std::size_t kMost = 16;    // neighbours of one wall
  static constexpr std::size_t kSlots = 512;  // walls kept, at most

  struct Slot {
    int wall = -1;
    std::size_t count = 0;
    std::array<WallLine, kMost> lines;
  };
  void fill(Slot& slot);

  const LineMap* map_ = nullptr;
  std::shared_ptr<const void> identity_;  // of the map whose neighbours are kept
  double reach_ = 0.0;
  std::vector<Slot> slots_;
  std::vector<int> near_;
};

}  // namespace adit
