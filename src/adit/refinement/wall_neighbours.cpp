#include "adit/refinement/wall_neighbours.hpp"

#include <algorithm>

namespace adit {
namespace {

/// Between two segments that do not cross, as in a cleaned map.
double distance(const Segment& a, const Segment& b) {
  return std::min({adit::distance(a, b.a), adit::distance(a, b.b), adit::distance(b, a.a),
                   adit::distance(b, a.b)});
}

}  // namespace

WallLine line_of(const LineMap& map, int wall) {
  const Segment& segment = map.walls()[static_cast<std::size_t>(wall)].segment;
  WallLine line;
  line.wall = wall;
  line.foot = segment.a;
  line.length = segment.length();
  line.along = (segment.b - segment.a) / line.length;
  line.normal = perpendicular(line.along);
  return line;
}

void WallNeighbours::reset(const LineMap& map, double reach) {
  map_ = &map;
  if (!slots_.empty() && identity_ == map.identity() && reach_ == reach) return;
  identity_ = map.identity();
  reach_ = reach;
  slots_.assign(std::clamp<std::size_t>(map.walls().size(), 1, kSlots), Slot{});
}

std::span<const WallLine> WallNeighbours::of(int wall) {
  Slot& slot = slots_[static_cast<std::size_t>(wall) % slots_.size()];
  if (slot.wall != wall) {
    slot.wall = wall;
    fill(slot);
  }
  return {slot.lines.data(), slot.count};
}

void WallNeighbours::fill(Slot& slot) {
  const Segment& segment = map_->walls()[static_cast<std::size_t>(slot.wall)].segment;
  near_.clear();
  map_->near(0.5 * (segment.a + segment.b), 0.5 * segment.length() + reach_, near_);
  const auto distance_to = [&](int other) {
    return distance(segment, map_->walls()[static_cast<std::size_t>(other)].segment);
  };
  std::array<double, kMost> distances{};
  slot.count = 0;
  for (const int other : near_) {
    if (other == slot.wall) continue;
    const double metres = distance_to(other);
    if (metres > reach_ || (slot.count == kMost && metres >= distances[kMost - 1])) continue;
    std::size_t place = slot.count < kMost ? slot.count++ : kMost - 1;
    for (; place > 0 && distances[place - 1] > metres; --place) {
      distances[place] = distances[place - 1];
      slot.lines[place] = slot.lines[place - 1];
    }
    distances[place] = metres;
    slot.lines[place] = line_of(*map_, other);
  }
}

}  // namespace adit
