#include "adit/survey/replaced_walls.hpp"

#include <algorithm>

namespace adit {

void ReplacedWalls::claim(std::size_t change, std::size_t wall, const Vector2d& point) {
  const double at = (point - surveyed_[wall].a).norm();
  claims_[wall].push_back({change, {at, at}});
}

std::vector<ReplacedWalls::Claim> ReplacedWalls::joined(std::vector<Claim> claims) {
  std::stable_sort(claims.begin(), claims.end(), [](const Claim& a, const Claim& b) {
    return a.stretch.from_m < b.stretch.from_m;
  });
  std::vector<Claim> out;
  for (const Claim& claim : claims) {
    if (!out.empty() && out.back().change == claim.change) {
      out.back().stretch.to_m = claim.stretch.to_m;
    } else {
      out.push_back(claim);
    }
  }
  return out;
}

std::vector<Replacement> ReplacedWalls::share_out(
    double step_m, const std::function<bool(std::size_t, const Vector2d&)>& is_plans_own) {
  std::vector<Replacement> out;
  for (std::size_t wall = 0; wall < claims_.size(); ++wall) {
    const Segment& s = surveyed_[wall];
    const double length = s.length();
    const std::vector<Claim> claims = joined(claims_[wall]);
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
      const SegmentPart stretch{grown(at.from_m, before), grown(at.to_m, after)};
      if (stretch.length_m() > 0.0) out.push_back({claims[i].change, wall, stretch});
    }
  }
  return out;
}

}  // namespace adit
