#pragma once

#include <iosfwd>
#include <optional>

#include "adit/geometry/result.hpp"
#include "adit/places/place_index.hpp"

namespace adit {

/// Writes an index, so that a large plan is looked around in once: what it was made of, then its
/// arrays as they lie in memory (little-endian).
Result<void> write_places(const PlaceIndex& places, const LineMap& map,
                          const PlaceIndexOptions& options, std::ostream& out);

/// Reads an index back; none if it was made of another plan or with other options than these.
/// Error: it is no index, or was cut short.
Result<std::optional<PlaceIndex>> read_places(const LineMap& map, const PlaceIndexOptions& options,
                                              std::istream& in);

}  // namespace adit
