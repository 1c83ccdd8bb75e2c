#include "adit/simulation/drive_map.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>

#include "adit/simulation/drive_lattice.hpp"

namespace adit {
namespace {

struct Offset {
  int column;
  int row;
};
constexpr std::array<Offset, 4> kForward = {{{1, 0}, {-1, 1}, {0, 1}, {1, 1}}};

constexpr double kLeastPart = 0.05;  // of the best set's weights: less is no opening to drive in

/// Linked sets of spots (union by path halving).
class Sets {
 public:
  explicit Sets(std::size_t count) : parent_(count) {
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

/// Spots of a lattice and which of them are linked.
class LinkedSpots {
 public:
  LinkedSpots(const DriveLattice& lattice, const WallBuckets& walls, double clearance)
      : lattice_(lattice), is_open_(lattice.spots.size()), links_(lattice.spots.size(), 0) {
    for (std::size_t i = 0; i < is_open_.size(); ++i) {
      is_open_[i] = lattice.spots[i].room >= clearance;
      if (is_open_[i]) link(i, walls, clearance);
    }
  }

  void keep_votes(int least) {
    for (std::size_t i = 0; i < is_open_.size(); ++i) {
      is_open_[i] = is_open_[i] && lattice_.spots[i].vote >= least;
    }
  }

  /// Keeps the sets whose weights sum to the greatest sum or a part of it, if that is above zero
  /// and, unless the rim's may be it, not of the set that the rim is linked with.
  bool keep_best(std::span<const double> weights, bool may_be_rim) {
    Sets sets(is_open_.size());
    for_links([&](std::size_t i, std::size_t k) { sets.join(i, k); });
    std::vector<double> sums(is_open_.size(), 0.0);
    for (std::size_t i = 0; i < is_open_.size(); ++i) {
      if (is_open_[i]) sums[sets.root(i)] += weights[i];
    }
    const auto best = std::max_element(sums.begin(), sums.end());
    const std::size_t rim = sets.root(0);
    if (*best <= 0.0) return false;
    if (!may_be_rim && sums[rim] == *best) return false;
    const double least = kLeastPart * *best;
    for (std::size_t i = 0; i < is_open_.size(); ++i) {
      const std::size_t root = sets.root(i);
      is_open_[i] = is_open_[i] && sums[root] >= least && (may_be_rim || root != rim);
    }
    return true;
  }

  bool is_open(std::size_t i) const { return is_open_[i]; }

  /// Calls `use(i, k)` once for each pair of open spots that are linked.
  template <class Use>
  void for_links(Use&& use) const {
    for (std::size_t i = 0; i < is_open_.size(); ++i) {
      for (std::size_t d = 0; d < kForward.size(); ++d) {
        if (!is_open_[i] || (links_[i] & (1 << d)) == 0) continue;
        const std::size_t k = neighbour(i, kForward[d]);
        if (is_open_[k]) use(i, k);
      }
    }
  }

 private:
  std::size_t neighbour(std::size_t i, const Offset& to) const {
    return static_cast<std::size_t>(static_cast<std::ptrdiff_t>(i) +
                                    std::ptrdiff_t{to.row} * lattice_.columns + to.column);
  }

  void link(std::size_t i, const WallBuckets& walls, double clearance) {
    const int column = static_cast<int>(i % static_cast<std::size_t>(lattice_.columns));
    const int row = static_cast<int>(i / static_cast<std::size_t>(lattice_.columns));
    for (std::size_t d = 0; d < kForward.size(); ++d) {
      const int to = column + kForward[d].column;
      if (to < 0 || to >= lattice_.columns || row + kForward[d].row >= lattice_.rows) continue;
      const DriveLattice::Spot& a = lattice_.spots[i];
      const DriveLattice::Spot& b = lattice_.spots[neighbour(i, kForward[d])];
      if (b.room < clearance) continue;
      const double half = 0.5 * (b.position - a.position).norm();
      // No point of the piece is farther than half of it from an end.
      const bool is_clear = std::min(a.room, b.room) - half >= clearance ||
                            walls.clearance({a.position, b.position}, clearance) >= clearance;
      if (is_clear) links_[i] = static_cast<std::uint8_t>(links_[i] | (1 << d));
    }
  }

  const DriveLattice& lattice_;
  std::vector<bool> is_open_;
  std::vector<std::uint8_t> links_;
};

/// How many of the points lie in each square.
std::vector<double> points_in_squares(const DriveLattice& lattice,
                                      std::span<const Vector2d> points) {
  std::vector<double> counts(lattice.spots.size(), 0.0);
  for (const Vector2d& point : points) {
    const Vector2d at = (point - lattice.corner) / lattice.pitch_m;
    if (!(at.minCoeff() >= 0.0 && at.x() < lattice.columns && at.y() < lattice.rows)) continue;
    counts[static_cast<std::size_t>(at.y()) * static_cast<std::size_t>(lattice.columns) +
           static_cast<std::size_t>(at.x())] += 1.0;
  }
  return counts;
}

std::vector<double> votes_of(const DriveLattice& lattice) {
  std::vector<double> votes;
  votes.reserve(lattice.spots.size());
  for (const DriveLattice::Spot& spot : lattice.spots) votes.push_back(spot.vote);
  return votes;
}

/// Leaves the openings alone; none where nothing looks like one.
bool keep_openings(const DriveLattice& lattice, std::span<const Vector2d> inside,
                   LinkedSpots& spots) {
  const std::vector<double> weights =
      inside.empty() ? votes_of(lattice) : points_in_squares(lattice, inside);
  if (spots.keep_best(weights, false)) return true;
  // The openings leak into the rock around.
  spots.keep_votes(1);
  return spots.keep_best(weights, true);
}

}  // namespace

DriveMap::DriveMap(std::span<const Segment> walls, const DriveMapOptions& options,
                   std::span<const Vector2d> inside)
    : options_(options), walls_(walls) {
  // Two sides of a wall are more than a diagonal apart, so that a square has places of one alone.
  const DriveLattice lattice = lay_lattice(walls_, options.clearance_m, options.ample_m);
  corner_ = lattice.corner;
  pitch_m_ = lattice.pitch_m;
  columns_ = lattice.columns;
  rows_ = lattice.rows;
  place_in_square_.assign(lattice.spots.size(), -1);
  if (lattice.spots.empty()) return;
  LinkedSpots spots(lattice, walls_, options.clearance_m);
  if (!keep_openings(lattice, inside, spots)) return;
  for (std::size_t i = 0; i < lattice.spots.size(); ++i) {
    if (!spots.is_open(i)) continue;
    place_in_square_[i] = static_cast<int>(places_.size());
    places_.push_back({lattice.spots[i].position, lattice.spots[i].room});
  }
  std::vector<std::vector<int>> links(places_.size());
  spots.for_links([&](std::size_t i, std::size_t k) {
    links[static_cast<std::size_t>(place_in_square_[i])].push_back(place_in_square_[k]);
    links[static_cast<std::size_t>(place_in_square_[k])].push_back(place_in_square_[i]);
  });
  for (const std::vector<int>& of_place : links) {
    first_link_.push_back(static_cast<int>(links_.size()));
    links_.insert(links_.end(), of_place.begin(), of_place.end());
  }
  first_link_.push_back(static_cast<int>(links_.size()));
}

std::span<const int> DriveMap::links(std::size_t i) const {
  const auto begin = static_cast<std::size_t>(first_link_[i]);
  return std::span(links_).subspan(begin, static_cast<std::size_t>(first_link_[i + 1]) - begin);
}

bool DriveMap::is_clear(const Vector2d& from, const Vector2d& to) const {
  return walls_.clearance({from, to}, options_.clearance_m) >= options_.clearance_m;
}

int DriveMap::place_near(const Vector2d& point) const {
  constexpr int kSquares = 2;
  int nearest = -1;
  double least = std::numeric_limits<double>::infinity();
  const Vector2d at = (point - corner_) / pitch_m_;
  if (empty() || !at.allFinite() || at.cwiseAbs().maxCoeff() > 1e9) return nearest;
  const int column = static_cast<int>(std::floor(at.x()));
  const int row = static_cast<int>(std::floor(at.y()));
  for (int r = std::max(0, row - kSquares); r <= std::min(rows_ - 1, row + kSquares); ++r) {
    for (int c = std::max(0, column - kSquares); c <= std::min(columns_ - 1, column + kSquares);
         ++c) {
      const int place =
          place_in_square_[static_cast<std::size_t>(r) * static_cast<std::size_t>(columns_) +
                           static_cast<std::size_t>(c)];
      if (place < 0) continue;
      const Vector2d& position = places_[static_cast<std::size_t>(place)].position;
      const double squared = (position - point).squaredNorm();
      if (squared >= least || !is_clear(point, position)) continue;
      least = squared;
      nearest = place;
    }
  }
  return nearest;
}

}  // namespace adit
