#include "adit/refinement/corner_zone.hpp"

#include "adit/refinement/wall_neighbours.hpp"

namespace adit {

bool is_corner(const LineMap& map, int wall, int vertex) {
  constexpr double kStraight = 0.94;  // cosine of 20 degrees
  const WallLine here = line_of(map, wall);
  for (const int other : map.walls_at(vertex)) {
    if (other == wall) continue;
    if (std::abs(line_of(map, other).along.dot(here.along)) < kStraight) return true;
  }
  return false;
}

}  // namespace adit
