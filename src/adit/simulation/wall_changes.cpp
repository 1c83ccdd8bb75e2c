#include "adit/simulation/wall_changes.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace adit {
namespace {

constexpr double kLongestWhole = 10.0;  // m: longer chains are taken out in stretches
constexpr double kShortestGap = 3.0;    // m
constexpr double kJoined = 1e-3;        // m: ends this near are one
constexpr double kAbuts = 0.02;         // m: a wall that ends this near to another ends on it
constexpr double kShortestLeft = 0.05;  // m: a neighbour is not made shorter than this

std::vector<std::size_t> shuffled(std::size_t count, Random& random) {
  std::vector<std::size_t> order(count);
  for (std::size_t i = 0; i < count; ++i) order[i] = i;
  for (std::size_t i = count; i > 1; --i) {
    std::swap(order[i - 1], order[static_cast<std::size_t>(random.below(static_cast<int>(i)))]);
  }
  return order;
}

/// Appends what is left of a chain after a gap of at most `budget` metres; returns its length.
double cut_gap(const WallChain& chain, double budget, Random& random,
               std::vector<WallChain>& left) {
  const double length = chain.length();
  double gap = length <= kLongestWhole ? length : random.uniform(kShortestGap, kLongestWhole);
  gap = std::min(gap, budget);
  if (gap >= length) return length;
  const double from = random.uniform(0.0, length - gap);
  if (from > 0.0) left.push_back(part_of(chain, 0.0, from));
  if (from + gap < length) left.push_back(part_of(chain, from + gap, length));
  return gap;
}

bool is_joined(const Vector2d& p, const Vector2d& q) { return (p - q).norm() <= kJoined; }

WallChain moved(WallChain chain, const Vector2d& by) {
  for (Vector2d& point : chain.points) point += by;
  return chain;
}

/// A unit vector across the chain's way from end to end, or across its first piece if it is closed.
Vector2d across(const WallChain& chain) {
  Vector2d along = chain.points.back() - chain.points.front();
  if (along.norm() <= kJoined) along = chain.points[1] - chain.points[0];
  return perpendicular(along.normalized());
}

/// Displaces chains and joins their neighbours to them again.
class Displacer {
 public:
  Displacer(std::vector<WallChain> chains, const WayClearance& way)
      : chains_(std::move(chains)), way_(way), is_settled_(chains_.size(), false) {}

  const std::vector<WallChain>& chains() const { return chains_; }
  bool is_settled(std::size_t i) const { return is_settled_[i]; }

  /// False where the chain would come too near to the way.
  bool displace(std::size_t i, const Vector2d& by) {
    const WallChain there = moved(chains_[i], by);
    if (!way_.allows(there)) return false;
    const WallChain before = std::exchange(chains_[i], there);
    is_settled_[i] = true;
    if (!before.is_closed()) {
      join(i, before.points.front(), by);
      join(i, before.points.back(), by);
    }
    join_abutting(i, before, by);
    return true;
  }

  std::vector<WallChain> take() {
    chains_.insert(chains_.end(), joints_.begin(), joints_.end());
    return std::move(chains_);
  }

 private:
  void add_joint(const Vector2d& from, const Vector2d& to) {
    if (!is_joined(from, to)) joints_.push_back({{from, to}});
  }

  /// Joins what met the displaced chain at its corner. Where one neighbour alone did and the chain
  /// moved into it, it is made shorter.
  void join(std::size_t displaced, const Vector2d& corner, const Vector2d& by) {
    std::vector<std::size_t> neighbours;
    for (std::size_t i = 0; i < chains_.size(); ++i) {
      if (i == displaced || chains_[i].is_closed()) continue;
      if (is_joined(chains_[i].points.front(), corner) ||
          is_joined(chains_[i].points.back(), corner)) {
        neighbours.push_back(i);
        is_settled_[i] = true;
      }
    }
    Vector2d end = corner;
    if (neighbours.size() == 1) end = shorten(chains_[neighbours.front()], corner, by);
    if (!neighbours.empty()) add_joint(end, corner + by);
  }

  /// Takes from the chain's end at the corner what lies on the displaced side; returns the new end.
  static Vector2d shorten(WallChain& chain, const Vector2d& corner, const Vector2d& by) {
    const bool is_front = is_joined(chain.points.front(), corner);
    const std::size_t n = chain.points.size();
    const Vector2d leaving = is_front ? Vector2d(chain.points[1] - chain.points[0])
                                      : Vector2d(chain.points[n - 2] - chain.points[n - 1]);
    const double length = chain.length();
    const double cut = by.dot(leaving.normalized());
    if (cut <= kJoined || cut >= length - kShortestLeft) return corner;
    chain = is_front ? part_of(chain, cut, length) : part_of(chain, 0.0, length - cut);
    return is_front ? chain.points.front() : chain.points.back();
  }

  /// Draws walls on that ended on the displaced chain's side.
  void join_abutting(std::size_t displaced, const WallChain& before, const Vector2d& by) {
    const std::vector<Segment> pieces = segments_of(std::span(&before, 1));
    for (std::size_t i = 0; i < chains_.size(); ++i) {
      if (i == displaced || chains_[i].is_closed()) continue;
      for (const Vector2d& end : {chains_[i].points.front(), chains_[i].points.back()}) {
        if (is_joined(end, before.points.front()) || is_joined(end, before.points.back())) continue;
        const bool abuts = std::any_of(pieces.begin(), pieces.end(), [&](const Segment& piece) {
          return distance(piece, end) <= kAbuts;
        });
        if (abuts) add_joint(end, end + by);
      }
    }
  }

  std::vector<WallChain> chains_;
  const WayClearance& way_;
  std::vector<bool> is_settled_;  // displaced, or the neighbour of one that is
  std::vector<WallChain> joints_;
};

}  // namespace

bool WayClearance::allows(const WallChain& wall) const {
  const std::vector<Segment> pieces = segments_of(std::span(&wall, 1));
  return std::all_of(pieces.begin(), pieces.end(),
                     [&](const Segment& piece) { return is_clear_of(way, piece, clearance_m); });
}

std::vector<WallChain> without_some(std::vector<WallChain> chains, double gone_m, Random& random) {
  constexpr double kNothing = 1e-6;  // m
  double budget = gone_m;
  while (budget > kNothing && !chains.empty()) {
    std::vector<WallChain> left;
    for (const std::size_t i : shuffled(chains.size(), random)) {
      if (budget > kNothing) {
        budget -= cut_gap(chains[i], budget, random, left);
      } else {
        left.push_back(std::move(chains[i]));
      }
    }
    chains = std::move(left);
  }
  return chains;
}

std::vector<WallChain> with_displaced(std::vector<WallChain> chains, double displaced_m,
                                      double offset_m, const WayClearance& way, Random& random) {
  const std::vector<std::size_t> order = shuffled(chains.size(), random);
  Displacer displacer(std::move(chains), way);
  double budget = displaced_m;
  for (const std::size_t i : order) {
    const double length = displacer.chains()[i].length();
    if (displacer.is_settled(i) || 0.5 * length > budget) continue;
    const double side = random.chance(0.5) ? 1.0 : -1.0;
    const Vector2d by = side * offset_m * across(displacer.chains()[i]);
    if (displacer.displace(i, by) || displacer.displace(i, -by)) budget -= length;
  }
  return displacer.take();
}

}  // namespace adit
