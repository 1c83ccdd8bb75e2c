#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "adit/features/features.hpp"
#include "adit/matching/bit_matrix.hpp"
#include "adit/matching/candidates.hpp"
#include "adit/matching/chain_search.hpp"
#include "adit/matching/clique_search.hpp"
#include "adit/matching/feature_view.hpp"
#include "adit/matching/matching_options.hpp"

namespace adit {

/// The largest consistent set found, counter-clockwise by sensed azimuth. `pairs` views the
/// matcher's buffers and holds until the next call.
struct MatchResult {
  std::span<const FeaturePair> pairs;
  int candidates = 0;      ///< pairs that passed the unary constraints
  int calls = 0;           ///< recursive calls of the search
  bool is_maximum = true;  ///< false when max_calls or max_candidates cut the search short
};

/// Feature matching (the paper, III-F). Keeps its buffers between calls.
///
/// The unary constraints make the list of candidate pairs, the ternary ones a graph over it, and a
/// depth-first search finds the largest consistent set. Among sets of equal size the one wins whose
/// pairs agree best with all that they are compatible with; the same input gives the same output.
class Matcher {
 public:
  /// Both lists in the frame of the predicted pose of the scanner: sensed features as extracted,
  /// model features transformed with the predicted pose. Features that `order` leaves out, and
  /// those with numbers that are not finite, are never matched.
  MatchResult match(const FeatureList& sensed, const FeatureList& model,
                    const MatchingOptions& options);

 private:
  FeatureViews sensed_;
  FeatureViews model_;
  CandidateList candidates_;
  BitMatrix compatible_;
  std::vector<std::int64_t> weights_;
  CliqueSearch cliques_;
  ChainSearch chains_;
  std::vector<int> ranks_;
  std::vector<FeaturePair> pairs_;
};

}  // namespace adit
