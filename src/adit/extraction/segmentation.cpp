#include "adit/extraction/segmentation.hpp"

#include <algorithm>

namespace adit {
namespace {

/// A run of points that stands off the line of its stretch, such as a column before a wall.
struct Bump {
  ScanStretch points;
  double gain = 0.0;  ///< chi-square that three lines save over one
};

/// The run that stands off most. One cut, which leaves the run with one of its neighbours, does not
/// show it; two at once do.
Bump strongest_bump(const ScanPoints& points, ScanStretch s, std::size_t min_points) {
  const LineFit line = fit_line(points.moments(s.begin, s.end));
  const Vector2d normal = perpendicular(line.direction);
  const double distance = normal.dot(line.centroid);
  Bump best;
  for (std::size_t width = min_points; width <= s.size() / 2; width += 1 + width / 2) {
    for (std::size_t i = s.begin; i + width <= s.end; i += 1 + width / 4) {
      const Moments m = points.moments(i, i + width);
      const Vector2d middle(m.x / m.n, m.y / m.n);
      const double off = normal.dot(middle) - distance;
      const double range2 = middle.squaredNorm();
      const double cos2 = std::clamp(distance * distance / range2, 0.02, 1.0);
      const double gain = m.n * off * off / points.noise().across(cos2, range2);
      if (gain > best.gain) best = {{i, i + width}, gain};
    }
  }
  if (best.gain > 0.0) {
    best.gain = points.chi_square(s.begin, s.end) - points.chi_square(s.begin, best.points.begin) -
                points.chi_square(best.points.begin, best.points.end) -
                points.chi_square(best.points.end, s.end);
  }
  return best;
}

void cut_at(std::size_t index, std::size_t at, std::vector<ScanStretch>& stretches) {
  const ScanStretch whole = stretches[index];
  if (at <= whole.begin || at >= whole.end) return;
  stretches[index].end = at;
  stretches.insert(stretches.begin() + static_cast<std::ptrdiff_t>(index) + 1,
                   ScanStretch{at, whole.end});
}

/// Cuts what is not straight while lines of their own gain enough for its parts; the new stretches
/// take its place.
void split(const ScanPoints& points, std::size_t index, const CornerDecision& decision,
           std::vector<ScanStretch>& stretches) {
  while (index < stretches.size()) {
    const ScanStretch whole = stretches[index];
    const bool straight = is_straight(points, whole, decision.straight_sigmas);
    const BestCut best = straight ? BestCut{} : search(points, whole, 2);
    const Bump bump = straight ? Bump{} : strongest_bump(points, whole, decision.min_points);
    const double two_cuts = bump.gain - 0.5 * decision.chi_square;  // a second cut has its price
    if (std::max(best.gain, two_cuts) < decision.chi_square) {
      ++index;
    } else if (best.gain >= two_cuts) {
      cut_at(index, best.cut, stretches);
    } else {
      cut_at(index, bump.points.end, stretches);
      cut_at(index, bump.points.begin, stretches);
    }
  }
}

double joining_costs(const ScanPoints& points, const ScanStretch& a, const ScanStretch& b) {
  return points.chi_square(a.begin, b.end) - points.chi_square(a.begin, a.end) -
         points.chi_square(b.begin, b.end);
}

/// Joins neighbours, the most alike first, while one line explains both.
void merge(const ScanPoints& points, std::size_t first, const CornerDecision& decision,
           std::vector<ScanStretch>& stretches) {
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

void move_cuts(const ScanPoints& points, std::size_t first, std::vector<ScanStretch>& stretches) {
  for (std::size_t i = first; i + 1 < stretches.size(); ++i) {
    const ScanStretch both{stretches[i].begin, stretches[i + 1].end};
    if (both.size() < 4) continue;
    const BestCut best = descend(points, both, stretches[i].end, 2);
    stretches[i].end = best.cut;
    stretches[i + 1].begin = best.cut;
  }
}

}  // namespace

void segment_piece(const ScanPoints& points, ScanStretch piece,
                   const std::vector<std::size_t>& cuts, const CornerDecision& decision,
                   std::vector<ScanStretch>& stretches) {
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
