#include "adit/simulation/way.hpp"

#include <algorithm>

#include "adit/simulation/ray_caster.hpp"

namespace adit {
namespace {

constexpr double kLongestLink = 3.0;  // m: poses further apart are not joined by a drive

}  // namespace

double distance_between(const Segment& s, const Segment& t) {
  const double range = cast_ray(t, s.a, (s.b - s.a).normalized());
  if (s.length() > 0.0 && range <= s.length()) return 0.0;
  return std::min({distance(s, t.a), distance(s, t.b), distance(t, s.a), distance(t, s.b)});
}

std::vector<Segment> way_of(std::span<const Pose2> path) {
  std::vector<Segment> way;
  for (std::size_t i = 0; i < path.size(); ++i) {
    const Vector2d here = path[i].translation();
    const Vector2d next = i + 1 < path.size() ? path[i + 1].translation() : here;
    way.push_back({here, (next - here).norm() <= kLongestLink ? next : here});
  }
  return way;
}

bool is_clear_of(std::span<const Segment> way, const Segment& s, double clearance) {
  const Vector2d middle = 0.5 * (s.a + s.b);
  const double far = clearance + 0.5 * s.length() + kLongestLink;
  return std::none_of(way.begin(), way.end(), [&](const Segment& link) {
    // No link is longer than kLongestLink: most are told to be far by one end.
    if ((link.a - middle).squaredNorm() > far * far) return false;
    return distance_between(s, link) < clearance;
  });
}

}  // namespace adit
