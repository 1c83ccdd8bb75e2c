#include "adit/extraction/segmentation.hpp"

#include <algorithm>

namespace adit {
namespace {

/// Cuts the stretch at `index` while two lines gain enough; the new stretches take its place.
void split(const ScanPoints& points, std::size_t index, const CornerDecision& decision,
           std::vector<Stretch>& stretches) {
  while (index < stretches.size()) {
    const Stretch whole = stretches[index];
    if (is_straight(points, whole, decision.straight_sigmas)) {
      ++index;
      continue;
    }
    const BestCut best = search(points, whole, 2);
    if (best.gain < decision.chi_square) {
      ++index;
      continue;
    }
    stretches[index].end = best.cut;
    stretches.insert(stretches.begin() + static_cast<std::ptrdiff_t>(index) + 1,
                     Stretch{best.cut, whole.end});
  }
}

double joining_costs(const ScanPoints& points, const Stretch& a, const Stretch& b) {
  return points.chi_square(a.begin, b.end) - points.chi_square(a.begin, a.end) -
         points.chi_square(b.begin, b.end);
}

/// Joins neighbours, the most alike first, while one line explains both.
void merge(const ScanPoints& points, std::size_t first, const CornerDecision& decision,
           std::vector<Stretch>& stretches) {
  while (stretches.size() > first + 1) {
    std::size_t cheapest = first;
    double least = decision.chi_square;
    for (std::size_t i = first; i + 1 < stretches.size(); ++i) {
      const double cost = joining_costs(points, stretches[i], stretches[i + 1]);
      if (cost < least) {
        least = cost;
        cheapest = i;
      }
    }
    if (least >= decision.chi_square) return;
    stretches[cheapest].end = stretches[cheapest + 1].end;
    stretches.erase(stretches.begin() + static_cast<std::ptrdiff_t>(cheapest) + 1);
  }
}

void move_cuts(const ScanPoints& points, std::size_t first, std::vector<Stretch>& stretches) {
  for (std::size_t i = first; i + 1 < stretches.size(); ++i) {
    const Stretch both{stretches[i].begin, stretches[i + 1].end};
    if (both.size() < 4) continue;
    const BestCut best = descend(points, both, stretches[i].end, 2);
    stretches[i].end = best.cut;
    stretches[i + 1].begin = best.cut;
  }
}

}  // namespace

void segment_piece(const ScanPoints& points, Stretch piece, const std::vector<std::size_t>& cuts,
                   const CornerDecision& decision, std::vector<Stretch>& stretches) {
  const std::size_t first = stretches.size();
  std::size_t begin = piece.begin;
  for (const std::size_t cut : cuts) {
    stretches.push_back({begin, cut});
    begin = cut;
  }
  stretches.push_back({begin, piece.end});
  split(points, first, decision, stretches);
  merge(points, first, decision, stretches);
  move_cuts(points, first, stretches);
}

}  // namespace adit
