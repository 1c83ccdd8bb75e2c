#pragma once

#include <cstdint>
#include <vector>

#include "adit/matching/bit_matrix.hpp"
#include "adit/matching/candidates.hpp"

namespace adit {

/// Weight of one pair in the search: sets of more pairs always weigh more, whatever the rest says.
inline constexpr std::int64_t kPairWeight = std::int64_t{1} << 40;

/// Compares every two candidates and sets the bits of those that agree, both ways.
///
/// One sensed line may be several model lines if these are collinear, and several sensed lines one
/// model line if they lie on it together. A sensed corner is one model corner, since two corners of
/// a plan are two places; two sensed corners are one model corner only where they are one corner
/// that the scan broke in two. In `paper` mode the paper's comparisons alone decide, except that
/// the several model lines of a sensed line must be collinear.
///
/// `weights` gets for every candidate `kPairWeight` plus a small reward for how well it agrees with
/// those it is compatible with; it decides between consistent sets of the same size.
void find_compatible(const FeatureViews& sensed, const FeatureViews& model,
                     const CandidateList& candidates, const MatchingOptions& options,
                     BitMatrix& compatible, std::vector<std::int64_t>& weights);

}  // namespace adit
