#pragma once

#include <cstdint>

#include "adit/simulation/world.hpp"

namespace adit {

/// Lays ramps on the way: each rises or falls from a random pose along its heading, as wide as the
/// opening there (at most 12 m), 8 to 20 m long, sloped by 5 to 9 degrees. Ramps do not overlap.
/// Returns how many found room.
int lay_ramps(World& world, int count, std::uint64_t seed);

}  // namespace adit
