#pragma once

#include <vector>

#include "adit/simulation/random.hpp"
#include "adit/simulation/wall_chains.hpp"
#include "adit/simulation/way.hpp"

namespace adit {

/// The vehicle's way, and how near to it (m) no wall may be put.
struct WayClearance {
  std::vector<Segment> way;
  double clearance_m = 0.0;

  bool allows(const WallChain& wall) const;
};

/// What is left when `gone_m` metres are taken out: chains of up to 10 m whole, of longer ones
/// stretches of 3 to 10 m.
std::vector<WallChain> without_some(std::vector<WallChain> chains, double gone_m, Random& random);

/// The same walls where single chains, `displaced_m` metres of them (to within half a chain), stand
/// `offset_m` off across, to one side or the other. No two neighbours are displaced. At the corners
/// the neighbours are shortened or drawn on, so that all stays joined; so are walls that abut.
std::vector<WallChain> with_displaced(std::vector<WallChain> chains, double displaced_m,
                                      double offset_m, const WayClearance& way, Random& random);

/// With `added_m` metres of walls more: stoppings across openings of 1 to 10 m, stubs, and masonry
/// at walls, up to the middle of the opening. A plan does not say where rock is: of the two sides
/// of a wall the narrower one counts as the opening.
std::vector<WallChain> with_added(std::vector<WallChain> chains, double added_m,
                                  const WayClearance& way, Random& random);

}  // namespace adit
