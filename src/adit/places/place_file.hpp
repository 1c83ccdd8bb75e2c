#pragma once

#include <cstdint>
#include <iosfwd>
#include <optional>

#include "adit/geometry/result.hpp"
#include "adit/places/coding.hpp"
#include "adit/places/place_index.hpp"

namespace adit {

/// A hash of all that an index is made of: the plan's walls, the options, and what the code makes
/// it with.
std::uint64_t place_key(const LineMap& map, const PlaceIndexOptions& options,
                        const PlaceCoding& coding = kPlaceCoding);

/// Writes an index, so that a large plan is looked around in once: what it was made of, then its
/// arrays as they lie in memory (little-endian).
Result<void> write_places(const PlaceIndex& places, const LineMap& map,
                          const PlaceIndexOptions& options, std::ostream& out);

/// Reads an index back; none if it was made of another plan, with other options than these, or
/// by code that makes other indices. Error: it is no index, or was cut short.
Result<std::optional<PlaceIndex>> read_places(const LineMap& map, const PlaceIndexOptions& options,
                                              std::istream& in);

}  // namespace adit
