#include "adit/extraction/corner_operator.hpp"

#include <algorithm>
#include <cmath>

namespace adit {
namespace {

double two_lines(const ScanPoints& points, ScanStretch s, std::size_t cut) {
  return points.chi_square(s.begin, cut) + points.chi_square(cut, s.end);
}

double squared_distance(const ScanPoints& p, std::size_t i, std::size_t j) {
  const double dx = p.x(i) - p.x(j);
  const double dy = p.y(i) - p.y(j);
  return dx * dx + dy * dy;
}

}  // namespace

bool is_straight(const ScanPoints& points, ScanStretch s, double sigmas) {
  return points.is_straight(s.begin, s.end, sigmas);
}

BestCut descend(const ScanPoints& points, ScanStretch s, std::size_t start,
                std::size_t min_points) {
  const std::size_t low = s.begin + min_points;
  const std::size_t high = s.end >= min_points ? s.end - min_points : 0;
  if (low > high) return {start, 0.0};
  std::size_t cut = std::clamp(start, low, high);
  double best = two_lines(points, s, cut);
  // Steps shrink, so that a shallow bump of noise does not stop the descent.
  for (std::size_t step = std::max<std::size_t>(1, s.size() / 16);; step /= 2) {
    for (bool moved = true; moved;) {
      moved = false;
      for (const std::size_t next : {cut - std::min(step, cut - low), std::min(cut + step, high)}) {
        const double error = two_lines(points, s, next);
        if (error < best) {
          best = error;
          cut = next;
          moved = true;
        }
      }
    }
    if (step == 1) break;
  }
  return {cut, points.chi_square(s.begin, s.end) - best};
}

BestCut search(const ScanPoints& points, ScanStretch s, std::size_t min_points) {
  if (s.size() < 2 * min_points) return {s.begin, 0.0};
  const std::size_t stride = std::max<std::size_t>(1, s.size() / 32);
  BestCut best{s.begin + min_points, -1.0};
  double least = -1.0;
  for (std::size_t cut = s.begin + min_points; cut + min_points <= s.end; cut += stride) {
    const double error = two_lines(points, s, cut);
    if (least < 0.0 || error < least) {
      least = error;
      best.cut = cut;
    }
  }
  return descend(points, s, best.cut, min_points);
}

void CornerOperator::find(const ScanPoints& points, ScanStretch piece,
                          const std::vector<double>& sizes, const CornerDecision& decision,
                          std::vector<std::size_t>& cuts) {
  accepted_.clear();
  settled_.assign(points.size(), 0);
  for (const double size : sizes) {
    slide(points, piece, size, decision);
    accept_peaks(points, decision);
  }
  std::sort(accepted_.begin(), accepted_.end(),
            [](const Response& a, const Response& b) { return a.point < b.point; });
  for (const Response& corner : accepted_) {
    if (cuts.empty() || cuts.back() < corner.point) cuts.push_back(corner.point);
  }
}

void CornerOperator::slide(const ScanPoints& points, ScanStretch piece, double size,
                           const CornerDecision& decision) {
  responses_.clear();
  const double squared_size = size * size;
  const double squared_least = 0.25 * squared_size;
  std::size_t low = piece.begin;
  std::size_t high = piece.begin;
  for (std::size_t i = piece.begin + decision.min_points; i + decision.min_points <= piece.end;) {
    if (settled_[i] != 0) {
      ++i;
      continue;
    }
    // The arms' ends need not be exact: they move in steps of an eighth of the arm.
    while (squared_distance(points, low, i) > squared_size) low += 1 + (i - low) / 8;
    low = std::min(low, i);
    high = std::max(high, i);
    while (high < piece.end && squared_distance(points, high, i) <= squared_size) {
      high += 1 + (high - i) / 8;
    }
    high = std::min(high, piece.end);
    const std::size_t left = i - low;
    const std::size_t right = high - i;
    if (left >= decision.min_points && right >= decision.min_points &&
        squared_distance(points, low, i) >= squared_least &&
        squared_distance(points, high - 1, i) >= squared_least) {
      apply(points, {low, high}, i);
    }
    i += std::max<std::size_t>(1, std::min(left, right) / 4);
  }
}

/// One position of the operator. A window that one line explains well hides no smaller corner.
void CornerOperator::apply(const ScanPoints& points, ScanStretch window, std::size_t at) {
  if (is_straight(points, window, 1.0)) {
    settle(window);
    return;
  }
  const double one_line = points.chi_square(window.begin, window.end);
  responses_.push_back({at, window.begin, window.end, one_line - two_lines(points, window, at)});
}

bool CornerOperator::is_taken(std::size_t point) const {
  return std::any_of(accepted_.begin(), accepted_.end(), [point](const Response& corner) {
    return point >= corner.arm_begin && point < corner.arm_end;
  });
}

void CornerOperator::settle(ScanStretch window) {
  std::fill(settled_.begin() + static_cast<std::ptrdiff_t>(window.begin),
            settled_.begin() + static_cast<std::ptrdiff_t>(window.end), char{1});
}

void CornerOperator::accept_peaks(const ScanPoints& points, const CornerDecision& decision) {
  for (std::size_t k = 0; k < responses_.size(); ++k) {
    const Response& here = responses_[k];
    if (here.gain < decision.chi_square) continue;
    if (k > 0 && responses_[k - 1].gain > here.gain) continue;
    if (k + 1 < responses_.size() && responses_[k + 1].gain >= here.gain) continue;
    const ScanStretch window{here.arm_begin, here.arm_end};
    const BestCut best = descend(points, window, here.point, decision.min_points);
    const bool fits = is_straight(points, {window.begin, best.cut}, decision.straight_sigmas) &&
                      is_straight(points, {best.cut, window.end}, decision.straight_sigmas);
    if (!fits || is_taken(best.cut)) continue;
    accepted_.push_back({best.cut, window.begin, window.end, best.gain});
    settle(window);
  }
}

}  // namespace adit
