#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "adit/geometry/segment.hpp"

namespace adit {

/// Position along a Hilbert curve of order 32 over the whole range of both coordinates.
std::uint64_t hilbert_key(std::uint32_t x, std::uint32_t y);

/// The order in which a Hilbert curve passes the midpoints of the segments: what is near in the
/// plane is then near in memory. Equal places keep their order. Segments must be finite.
std::vector<int> hilbert_order(std::span<const Segment> segments);

}  // namespace adit
