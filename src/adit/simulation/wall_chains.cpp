#include "adit/simulation/wall_chains.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>

namespace adit {
namespace {

constexpr double kSameEnd = 1e-3;  // m
constexpr int kNone = -1;

/// One end of a segment: `end` 0 is a, 1 is b.
struct End {
  int segment = kNone;
  int end = 0;
};

using Links = std::vector<std::array<End, 2>>;  // for each end of each segment, what goes on there

const Vector2d& point(const Segment& s, int end) { return end == 0 ? s.a : s.b; }

/// Whether two segments that share this end go on as one wall.
bool goes_on(std::span<const Segment> walls, const End& s, const End& t, double corner_rad) {
  const Segment& from = walls[static_cast<std::size_t>(s.segment)];
  const Segment& onto = walls[static_cast<std::size_t>(t.segment)];
  const Vector2d in = point(from, s.end) - point(from, 1 - s.end);
  const Vector2d out = point(onto, 1 - t.end) - point(onto, t.end);
  return std::abs(std::atan2(cross(in, out), in.dot(out))) <= corner_rad;
}

Links link_ends(std::span<const Segment> walls, double corner_rad) {
  std::map<std::pair<std::int64_t, std::int64_t>, std::vector<End>> meetings;
  for (std::size_t i = 0; i < walls.size(); ++i) {
    for (int end = 0; end < 2; ++end) {
      const Vector2d at = point(walls[i], end) / kSameEnd;
      meetings[{std::llround(at.x()), std::llround(at.y())}].push_back({static_cast<int>(i), end});
    }
  }
  Links links(walls.size());
  for (const auto& [place, ends] : meetings) {
    if (ends.size() != 2 || ends[0].segment == ends[1].segment) continue;
    if (!goes_on(walls, ends[0], ends[1], corner_rad)) continue;
    for (std::size_t k = 0; k < 2; ++k) {
      links[static_cast<std::size_t>(ends[k].segment)][static_cast<std::size_t>(ends[k].end)] =
          ends[1 - k];
    }
  }
  return links;
}

/// From the segment's end backwards to where the chain begins, or once round.
End beginning(const Links& links, int segment) {
  End at{segment, 0};
  for (;;) {
    const End before =
        links[static_cast<std::size_t>(at.segment)][static_cast<std::size_t>(at.end)];
    if (before.segment == kNone || before.segment == segment) return at;
    at = {before.segment, 1 - before.end};
  }
}

}  // namespace

double WallChain::length() const {
  double sum = 0.0;
  for (std::size_t i = 1; i < points.size(); ++i) sum += (points[i] - points[i - 1]).norm();
  return sum;
}

std::vector<WallChain> chains_of(std::span<const Segment> walls, double corner_rad) {
  const Links links = link_ends(walls, corner_rad);
  std::vector<bool> is_taken(walls.size(), false);
  std::vector<WallChain> chains;
  for (std::size_t i = 0; i < walls.size(); ++i) {
    if (is_taken[i]) continue;
    WallChain chain;
    End at = beginning(links, static_cast<int>(i));
    while (at.segment != kNone && !is_taken[static_cast<std::size_t>(at.segment)]) {
      const Segment& wall = walls[static_cast<std::size_t>(at.segment)];
      is_taken[static_cast<std::size_t>(at.segment)] = true;
      if (chain.points.empty()) chain.points.push_back(point(wall, at.end));
      if (wall.length() > 0.0) chain.points.push_back(point(wall, 1 - at.end));
      at = links[static_cast<std::size_t>(at.segment)][static_cast<std::size_t>(1 - at.end)];
    }
    if (chain.points.size() < 2) continue;
    // Ends within a millimetre are one.
    if (at.segment != kNone) chain.points.back() = chain.points.front();
    chains.push_back(std::move(chain));
  }
  return chains;
}

std::vector<Segment> segments_of(std::span<const WallChain> chains) {
  std::vector<Segment> segments;
  for (const WallChain& chain : chains) {
    for (std::size_t i = 1; i < chain.points.size(); ++i) {
      segments.push_back({chain.points[i - 1], chain.points[i]});
    }
  }
  return segments;
}

WallChain part_of(const WallChain& chain, double from, double to) {
  WallChain part;
  double reached = 0.0;
  for (std::size_t i = 1; i < chain.points.size(); ++i) {
    const Vector2d& a = chain.points[i - 1];
    const Vector2d& b = chain.points[i];
    const double length = (b - a).norm();
    const auto at = [&](double way) -> Vector2d { return a + (way - reached) / length * (b - a); };
    if (part.points.empty() && from < reached + length) {
      part.points.push_back(from > reached ? at(from) : a);
    }
    if (!part.points.empty()) {
      if (to <= reached + length) {
        part.points.push_back(to < reached + length ? at(to) : b);
        return part;
      }
      part.points.push_back(b);
    }
    reached += length;
  }
  return part;
}

WallChain densified(const WallChain& chain, double spacing) {
  WallChain dense;
  dense.points.push_back(chain.points.front());
  for (std::size_t i = 1; i < chain.points.size(); ++i) {
    const Vector2d& a = chain.points[i - 1];
    const Vector2d& b = chain.points[i];
    const int pieces = std::max(1, static_cast<int>(std::ceil((b - a).norm() / spacing)));
    for (int k = 1; k < pieces; ++k) dense.points.emplace_back(a + (b - a) * k / pieces);
    dense.points.push_back(b);
  }
  return dense;
}

}  // namespace adit
