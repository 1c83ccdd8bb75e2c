#include "adit/survey/replaced_walls.hpp"

#include <algorithm>

namespace adit {
namespace {

constexpr double kNeighbours = 3.0;  // steps between two places of one stretch at most

}  // namespace

void ReplacedWalls::claim(std::size_t change, std::size_t wall, const Vector2d& point) {
  const double at = (point - surveyed_[wall].a).norm();
  claims_[wall].push_back({change, {at, at}});
}

std::vector<ReplacedWalls::Claim> ReplacedWalls::joined(std::vector<Claim> claims, double step_m) {
  std::stable_sort(claims.begin(), claims.end(), [](const Claim& a, const Claim& b) {
    return a.change != b.change ? a.change < b.change : a.stretch.from_m < b.stretch.from_m;
  });
  std::vector<Claim> out;
  for (const Claim& claim : claims) {
    const bool goes_on = !out.empty() && out.back().change == claim.change &&
                         claim.stretch.from_m - out.back().stretch.to_m <= kNeighbours * step_m;
    if (goes_on) {
      out.back().stretch.to_m = claim.stretch.to_m;
    } else {
      out.push_back(claim);
    }
  }
  return out;
}

/// In their order along the wall; where two lie over each other, the longer has it.
std::vector<ReplacedWalls::Claim> ReplacedWalls::apart(std::vector<Claim> claims) {
  std::stable_sort(claims.begin(), claims.end(), [](const Claim& a, const Claim& b) {
    return a.stretch.from_m < b.stretch.from_m;
  });
  std::vector<Claim> out;
  for (Claim claim : claims) {
    while (!out.empty() && claim.stretch.from_m < out.back().stretch.to_m) {
      SegmentPart& last = out.back().stretch;
      if (last.length_m() >= claim.stretch.length_m()) {
        claim.stretch.from_m = last.to_m;
        break;
      }
      last.to_m = claim.stretch.from_m;
      if (last.length_m() > 0.0) break;
      out.pop_back();
    }
    if (claim.stretch.length_m() >= 0.0) out.push_back(claim);
  }
  return out;
}

std::vector<Replacement> ReplacedWalls::share_out(
    double step_m, const std::function<bool(std::size_t, const Vector2d&)>& is_plans_own) {
  std::vector<Replacement> out;
  for (std::size_t wall = 0; wall < claims_.size(); ++wall) {
    const Segment& s = surveyed_[wall];
    const double length = s.length();
    const std::vector<Claim> claims = apart(joined(claims_[wall], step_m));
    const auto grown = [&](double from, double limit) {
      const double way = limit < from ? -step_m : step_m;
      while (std::abs(limit - from) > step_m) {
        const Vector2d next = s.a + (from + way) / length * (s.b - s.a);
        if (is_plans_own(wall, next)) return from;
        from += way;
      }
      return limit;
    };
    for (std::size_t i = 0; i < claims.size(); ++i) {
      const SegmentPart& at = claims[i].stretch;
      const double before = i > 0 ? 0.5 * (claims[i - 1].stretch.to_m + at.from_m) : 0.0;
      const double after =
          i + 1 < claims.size() ? 0.5 * (at.to_m + claims[i + 1].stretch.from_m) : length;
      SegmentPart stretch{grown(at.from_m, before), grown(at.to_m, after)};
      // A place stands for half a step on either side.
      stretch.from_m = std::max(before, std::min(stretch.from_m, at.from_m - 0.5 * step_m));
      stretch.to_m = std::min(after, std::max(stretch.to_m, at.to_m + 0.5 * step_m));
      if (stretch.length_m() > 0.0) out.push_back({claims[i].change, wall, stretch});
    }
  }
  return out;
}

}  // namespace adit
