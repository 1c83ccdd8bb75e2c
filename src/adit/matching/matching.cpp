#include "adit/matching/matching.hpp"

#include "adit/matching/compatibility.hpp"

namespace adit {

MatchResult Matcher::match(const FeatureList& sensed, const FeatureList& model,
                           const MatchingOptions& options) {
  make_views(sensed, options, sensed_);
  make_views(model, options, model_);
  find_candidates(sensed_, model_, options, candidates_);
  find_compatible(sensed_, model_, candidates_, options, compatible_, weights_);

  MatchResult result;
  std::span<const int> chosen;
  if (options.consistency == Consistency::clique) {
    chosen = cliques_.find(compatible_, weights_, options.max_calls);
    result.calls = cliques_.calls();
    result.is_maximum = cliques_.is_maximum();
  } else {
    ranks_.clear();
    for (const Candidate& pair : candidates_.pairs) ranks_.push_back(pair.model_rank);
    chosen = chains_.find(compatible_, ranks_, static_cast<int>(model_.order.size()), weights_,
                          options.max_calls);
    result.calls = chains_.calls();
    result.is_maximum = chains_.is_maximum();
  }
  result.candidates = static_cast<int>(candidates_.pairs.size());
  result.is_maximum = result.is_maximum && !candidates_.truncated;

  pairs_.clear();
  for (const int index : chosen) {
    const Candidate& pair = candidates_.pairs[static_cast<std::size_t>(index)];
    const auto s = static_cast<std::size_t>(pair.sensed);
    const auto m = static_cast<std::size_t>(pair.model);
    const bool corner = pair.kind == FeatureKind::corner;
    pairs_.push_back({pair.kind, corner ? sensed_.corners[s].index : sensed_.lines[s].index,
                      corner ? model_.corners[m].index : model_.lines[m].index});
  }
  result.pairs = pairs_;
  return result;
}

}  // namespace adit
