#include "adit/matching/compatibility.hpp"

#include <algorithm>

#include "adit/matching/ternary.hpp"

namespace adit {
namespace {

// The rewards of a whole set stay far below one pair: 2^8 per agreement and at most 2^15 of these
// per pair and pairs per set.
constexpr double kRewardScale = 256.0;

class Comparison {
 public:
  Comparison(const FeatureViews& sensed, const FeatureViews& model, const CandidateList& candidates,
             const MatchingOptions& options, BitMatrix& compatible,
             std::vector<std::int64_t>& weights)
      : sensed_(sensed),
        model_(model),
        candidates_(candidates),
        tolerances_(ternary_tolerances(options)),
        compatible_(compatible),
        weights_(weights) {}

  void run() {
    const auto& groups = candidates_.groups;
    for (std::size_t a = 0; a < groups.size(); ++a) {
      within_group(groups[a]);
      for (std::size_t b = a + 1; b < groups.size(); ++b) between_groups(groups[a], groups[b]);
    }
  }

 private:
  using Group = std::pair<int, int>;

  const Candidate& pair(int index) const {
    return candidates_.pairs[static_cast<std::size_t>(index)];
  }
  const CornerView& sensed_corner(const Candidate& c) const {
    return sensed_.corners[static_cast<std::size_t>(c.sensed)];
  }
  const CornerView& model_corner(const Candidate& c) const {
    return model_.corners[static_cast<std::size_t>(c.model)];
  }
  const LineView& sensed_line(const Candidate& c) const {
    return sensed_.lines[static_cast<std::size_t>(c.sensed)];
  }
  const LineView& model_line(const Candidate& c) const {
    return model_.lines[static_cast<std::size_t>(c.model)];
  }

  void enter(int a, int b, double disagreement) {
    if (!(disagreement <= 1.0)) return;
    const auto i = static_cast<std::size_t>(a);
    const auto j = static_cast<std::size_t>(b);
    compatible_.set_both(i, j);
    const auto reward = static_cast<std::int64_t>(kRewardScale * (1.0 - disagreement));
    weights_[i] += reward;
    weights_[j] += reward;
  }

  // Calls compare(a, b) for those of two groups whose turns agree.
  template <class Compare>
  void for_agreeing_turns(Group a, Group b, Compare&& compare) {
    for (int p = a.first; p < a.second; ++p) {
      for (int q = b.first; q < b.second; ++q) {
        const double turns = turns_disagreement(pair(p), pair(q), tolerances_, false);
        if (turns <= 1.0) enter(p, q, std::max(turns, compare(pair(p), pair(q))));
      }
    }
  }

  void between_groups(Group a, Group b) {
    const bool corner_a = pair(a.first).kind == FeatureKind::corner;
    const bool corner_b = pair(b.first).kind == FeatureKind::corner;
    if (corner_a && corner_b) {
      corners(a, b);
    } else if (corner_a) {
      corner_and_line(a, b);
    } else if (corner_b) {
      corner_and_line(b, a);
    } else {
      lines(a, b);
    }
  }

  void corners(Group a, Group b) {
    const CornerView& first = sensed_corner(pair(a.first));
    const CornerView& second = sensed_corner(pair(b.first));
    const CornersRelation sensed = relate(first, second, tolerances_);
    const bool may_share = !tolerances_.full || are_one_corner(first, second, tolerances_);
    const auto compare = [&](const Candidate& p, const Candidate& q) {
      if (p.model == q.model && !may_share) return 2.0;
      if (p.model == q.model && tolerances_.full) return 0.0;
      return corners_disagreement(sensed, relate(model_corner(p), model_corner(q)), tolerances_);
    };
    if (tolerances_.full) {
      for_agreeing_turns(a, b, compare);
      return;
    }
    // The paper compares corners by distance alone.
    for (int p = a.first; p < a.second; ++p) {
      for (int q = b.first; q < b.second; ++q) enter(p, q, compare(pair(p), pair(q)));
    }
  }

  void corner_and_line(Group corner, Group line) {
    const LineView& wall = sensed_line(pair(line.first));
    const CornerLineRelation sensed = relate(sensed_corner(pair(corner.first)), wall, tolerances_);
    for_agreeing_turns(corner, line, [&](const Candidate& p, const Candidate& q) {
      return corner_line_disagreement(sensed, relate(model_corner(p), model_line(q)), p, q, wall,
                                      tolerances_);
    });
  }

  void lines(Group a, Group b) {
    const LineView& first = sensed_line(pair(a.first));
    const LineView& second = sensed_line(pair(b.first));
    for_agreeing_turns(a, b, [&](const Candidate& p, const Candidate& q) {
      if (!tolerances_.full) return 0.0;
      return lines_disagreement(p, first, model_line(p), q, second, model_line(q), tolerances_,
                                false);
    });
  }

  void within_group(Group group) {
    for (int p = group.first; p < group.second; ++p) {
      for (int q = p + 1; q < group.second; ++q) enter(p, q, shared(pair(p), pair(q)));
    }
  }

  // Two model features for one sensed feature.
  double shared(const Candidate& p, const Candidate& q) const {
    if (p.kind == FeatureKind::corner) {
      if (tolerances_.full) return 2.0;
      const CornerView& sensed = sensed_corner(p);
      return corners_disagreement(relate(sensed, sensed), relate(model_corner(p), model_corner(q)),
                                  tolerances_);
    }
    if (!are_collinear(model_line(p), model_line(q), tolerances_)) return 2.0;
    const double turns = turns_disagreement(p, q, tolerances_, true);
    if (!tolerances_.full || turns > 1.0) return turns;
    const LineView& sensed = sensed_line(p);
    return std::max(turns, lines_disagreement(p, sensed, model_line(p), q, sensed, model_line(q),
                                              tolerances_, true));
  }

  const FeatureViews& sensed_;
  const FeatureViews& model_;
  const CandidateList& candidates_;
  const TernaryTolerances tolerances_;
  BitMatrix& compatible_;
  std::vector<std::int64_t>& weights_;
};

}  // namespace

void find_compatible(const FeatureViews& sensed, const FeatureViews& model,
                     const CandidateList& candidates, const MatchingOptions& options,
                     BitMatrix& compatible, std::vector<std::int64_t>& weights) {
  compatible.reset(candidates.pairs.size());
  weights.assign(candidates.pairs.size(), kPairWeight);
  Comparison(sensed, model, candidates, options, compatible, weights).run();
}

}  // namespace adit
