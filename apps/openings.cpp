#include "openings.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <numeric>
#include <utility>

namespace adit {
namespace {

using Cell = std::pair<std::int64_t, std::int64_t>;  // row, column

Cell cell_of(const Vector2d& place, const Vector2d& origin, double size) {
  const Vector2d at = (place - origin) / size;
  return {std::llround(at.y()), std::llround(at.x())};
}

/// Whether a wall stands between two places.
bool are_parted(const LineMap& map, const Vector2d& a, const Vector2d& b, std::vector<int>& near) {
  near.clear();
  map.near(0.5 * (a + b), 0.5 * (b - a).norm(), near);
  const auto side = [](const Vector2d& from, const Vector2d& to, const Vector2d& p) {
    return cross(to - from, p - from) > 0.0;
  };
  return std::any_of(near.begin(), near.end(), [&](int wall) {
    const Segment& s = map.walls()[static_cast<std::size_t>(wall)].segment;
    return side(s.a, s.b, a) != side(s.a, s.b, b) && side(a, b, s.a) != side(a, b, s.b);
  });
}

/// Regions of places, as sets that are merged (union by path halving).
class Regions {
 public:
  explicit Regions(std::size_t count) : parent_(count) {
    std::iota(parent_.begin(), parent_.end(), std::size_t{0});
  }
  std::size_t root(std::size_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  void join(std::size_t a, std::size_t b) { parent_[root(a)] = root(b); }

 private:
  std::vector<std::size_t> parent_;
};

/// Where the lines through the rows (axis 1) or columns (axis 0) of a lattice cross walls.
class Scanlines {
 public:
  Scanlines(const LineMap& map, int axis, double first, double pitch)
      : axis_(axis), first_(first), pitch_(pitch) {
    for (const Wall& wall : map.walls()) add(wall.segment);
    for (auto& [line, crossings] : lines_) std::sort(crossings.begin(), crossings.end());
  }

  /// Whether walls are crossed an odd number of times on the way out, in both senses: 1 for yes, -1
  /// for no, 0 where the two disagree.
  int vote(const Vector2d& place) const {
    const auto line = lines_.find(std::llround((place[axis_] - first_) / pitch_));
    if (line == lines_.end()) return -1;
    const std::vector<double>& crossings = line->second;
    const auto here = std::upper_bound(crossings.begin(), crossings.end(), place[1 - axis_]);
    const bool before = (here - crossings.begin()) % 2 != 0;
    const bool after = (crossings.end() - here) % 2 != 0;
    return before != after ? 0 : before ? 1 : -1;
  }

 private:
  void add(const Segment& s) {
    const double low = std::min(s.a[axis_], s.b[axis_]);
    const double high = std::max(s.a[axis_], s.b[axis_]);
    auto line = static_cast<std::int64_t>(std::ceil((low - first_) / pitch_));
    for (;; ++line) {
      const double at = first_ + pitch_ * static_cast<double>(line);
      if (!(at < high)) return;  // an upper end belongs to the next wall
      const double part = (at - s.a[axis_]) / (s.b[axis_] - s.a[axis_]);
      lines_[line].push_back(s.a[1 - axis_] + part * (s.b[1 - axis_] - s.a[1 - axis_]));
    }
  }

  int axis_;
  double first_;
  double pitch_;
  std::map<std::int64_t, std::vector<double>> lines_;
};

/// The places that lie in an odd number of outlines: in the mine, and not in its pillars. Where
/// hardly any does the plan is drawn in another way, and all places are as good as each other.
std::vector<Vector2d> places_inside(const LineMap& map, std::vector<Vector2d> places,
                                    double pitch_m, double least_inside) {
  if (places.empty()) return places;
  const Scanlines rows(map, 1, places.front().y(), pitch_m);
  const Scanlines columns(map, 0, places.front().x(), pitch_m);
  std::vector<Vector2d> inside;
  for (const Vector2d& place : places) {
    if (rows.vote(place) + columns.vote(place) > 0) inside.push_back(place);
  }
  const auto least = least_inside * static_cast<double>(places.size());
  return static_cast<double>(inside.size()) < least ? places : inside;
}

/// Drops the places in regions that are small beside the largest.
std::vector<Vector2d> places_in_large_regions(const LineMap& map,
                                              const std::vector<Vector2d>& places, double pitch_m,
                                              double least_part) {
  std::map<Cell, std::size_t> at;
  for (std::size_t i = 0; i < places.size(); ++i) {
    at.emplace(cell_of(places[i], places.front(), pitch_m), i);
  }
  Regions regions(places.size());
  std::vector<int> near;
  for (const auto& [cell, i] : at) {
    for (const Cell& beside :
         {Cell{cell.first, cell.second + 1}, Cell{cell.first + 1, cell.second}}) {
      const auto other = at.find(beside);
      if (other == at.end()) continue;
      const std::size_t k = other->second;
      if (!are_parted(map, places[i], places[k], near)) regions.join(i, k);
    }
  }
  std::vector<std::size_t> size(places.size(), 0);
  for (std::size_t i = 0; i < places.size(); ++i) ++size[regions.root(i)];
  const std::size_t largest = size.empty() ? 0 : *std::max_element(size.begin(), size.end());
  std::vector<Vector2d> kept;
  for (std::size_t i = 0; i < places.size(); ++i) {
    const auto part = static_cast<double>(size[regions.root(i)]);
    if (part >= least_part * static_cast<double>(largest)) kept.push_back(places[i]);
  }
  return kept;
}

}  // namespace

Openings openings_of(const LineMap& map, const PlaceIndex& index, std::optional<double> pitch_m,
                     const OpeningsOptions& options) {
  std::vector<Vector2d> open;
  for (std::size_t i = 0; i < index.size(); ++i) open.push_back(index.position(i));
  open = places_inside(map, std::move(open), index.pitch_m(), options.least_inside);
  open = places_in_large_regions(map, open, index.pitch_m(), options.least_part);
  std::vector<int> near;
  std::erase_if(open, [&](const Vector2d& place) {
    near.clear();
    map.near(place, options.least_clearance_m, near);
    return !near.empty();
  });
  Openings openings;
  const double area = static_cast<double>(open.size()) * index.pitch_m() * index.pitch_m();
  openings.pitch_m =
      pitch_m.value_or(std::max(options.least_pitch_m, std::sqrt(area / options.places)));
  struct Nearest {
    Vector2d place;
    double squared = 0.0;
  };
  std::map<Cell, Nearest> chosen;
  for (const Vector2d& place : open) {
    const Cell cell = cell_of(place, map.bounds().min, openings.pitch_m);
    const Vector2d middle =
        map.bounds().min + openings.pitch_m * Vector2d(static_cast<double>(cell.second),
                                                       static_cast<double>(cell.first));
    const double squared = (place - middle).squaredNorm();
    const auto [entry, is_new] = chosen.try_emplace(cell, Nearest{place, squared});
    if (!is_new && squared < entry->second.squared) entry->second = {place, squared};
  }
  for (const auto& [cell, nearest] : chosen) openings.places.push_back(nearest.place);
  return openings;
}

}  // namespace adit
