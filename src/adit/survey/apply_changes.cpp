#include <algorithm>

#include "adit/survey/plan_difference.hpp"

namespace adit {
namespace {

constexpr double kLeast = 1e-6;  // m: what is left of a wall

/// What is left of a wall without these stretches, which are in order.
void add_rest(const Segment& wall, std::span<const SegmentPart> cuts, std::vector<Segment>& out) {
  const Vector2d along = (wall.b - wall.a).normalized();
  double from = 0.0;
  for (const SegmentPart& cut : cuts) {
    if (cut.from_m - from > kLeast) {
      out.push_back({wall.a + from * along, wall.a + cut.from_m * along});
    }
    from = std::max(from, cut.to_m);
  }
  if (wall.length() - from > kLeast) out.push_back({wall.a + from * along, wall.b});
}

}  // namespace

const char* to_string(PlanChange change) {
  switch (change) {
    case PlanChange::gone:
      return "wall gone";
    case PlanChange::moved:
      return "wall moved";
    case PlanChange::cut:
      return "new cut";
    case PlanChange::obstacle:
      break;
  }
  return "new obstacle";
}

std::vector<Segment> apply_changes(std::span<const Segment> plan,
                                   std::span<const PlanChangeItem> accepted) {
  std::vector<std::vector<SegmentPart>> cuts(plan.size());
  for (const PlanChangeItem& item : accepted) {
    for (const PlanPiece& piece : item.pieces) {
      cuts[static_cast<std::size_t>(piece.segment)].push_back(piece.stretch);
    }
  }
  std::vector<Segment> changed;
  for (std::size_t i = 0; i < plan.size(); ++i) {
    if (cuts[i].empty()) {
      changed.push_back(plan[i]);
      continue;
    }
    std::sort(cuts[i].begin(), cuts[i].end(),
              [](const SegmentPart& a, const SegmentPart& b) { return a.from_m < b.from_m; });
    add_rest(plan[i], cuts[i], changed);
  }
  for (const PlanChangeItem& item : accepted) {
    changed.insert(changed.end(), item.added.begin(), item.added.end());
  }
  return changed;
}

}  // namespace adit
