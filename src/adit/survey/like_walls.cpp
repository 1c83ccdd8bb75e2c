#include "adit/survey/like_walls.hpp"

#include <algorithm>
#include <cmath>

namespace adit {

LikeWalls::LikeWalls(std::span<const Segment> segments, double parallel_rad)
    : segments_(segments.begin(), segments.end()),
      index_(segments_),
      cosine_(std::cos(parallel_rad)),
      sine_(std::sin(parallel_rad)) {}

std::optional<NearWall> LikeWalls::nearest(const Vector2d& p, const Vector2d& direction,
                                           double reach, double beside) const {
  std::optional<NearWall> best;
  index_.visit([&](const Box& box) { return box.squared_distance(p) <= reach * reach; },
               [&](const SegmentIndex::Entry& entry) {
                 const Segment& s = segments_[static_cast<std::size_t>(entry.segment)];
                 const double length = s.length();
                 if (length <= 0.0) return;
                 if (std::abs((s.b - s.a).dot(direction)) < cosine_ * length) return;
                 const Vector2d at = nearest_point(s, p);
                 const Vector2d way = at - p;
                 const double d = way.norm();
                 if (d > reach || (best && d >= best->distance)) return;
                 // The way to a wall that is not quite parallel leans by as much.
                 if (std::abs(way.dot(direction)) > std::max(beside, sine_ * d)) return;
                 best = {{entry.segment, d, at}};
               });
  return best;
}

bool LikeWalls::any_within(const Vector2d& p, double reach) const {
  bool found = false;
  index_.visit([&](const Box& box) { return box.squared_distance(p) <= reach * reach; },
               [&](const SegmentIndex::Entry& entry) {
                 const Segment& s = segments_[static_cast<std::size_t>(entry.segment)];
                 found = found || distance(s, p) <= reach;
               });
  return found;
}

int LikeWalls::crossings(const Vector2d& from, const Vector2d& to) const {
  const Box way = box_of({from, to});
  std::vector<int> met;
  index_.visit([&](const Box& box) { return box.overlaps(way); },
               [&](const SegmentIndex::Entry& entry) { met.push_back(entry.segment); });
  std::sort(met.begin(), met.end());
  met.erase(std::unique(met.begin(), met.end()), met.end());
  return static_cast<int>(std::count_if(met.begin(), met.end(), [&](int i) {
    const Segment& s = segments_[static_cast<std::size_t>(i)];
    const double a = cross(to - from, s.a - from);
    const double b = cross(to - from, s.b - from);
    const double c = cross(s.b - s.a, from - s.a);
    const double d = cross(s.b - s.a, to - s.a);
    return a * b < 0.0 && c * d < 0.0;
  }));
}

}  // namespace adit
