#pragma once

#include <vector>

#include "adit/extraction/corner_operator.hpp"

namespace adit {

/// From the corners of a piece to its straight stretches: stretches that are not straight are cut
/// where two lines explain them best, neighbours that one line explains as well are joined, and
/// every cut moves to where its two lines fit best. Appends to `stretches`, in order, without gaps.
void segment_piece(const ScanPoints& points, ScanStretch piece,
                   const std::vector<std::size_t>& cuts, const CornerDecision& decision,
                   std::vector<ScanStretch>& stretches);

}  // namespace adit
