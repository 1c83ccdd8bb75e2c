#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "adit/simulation/ray_caster.hpp"
#include "adit/simulation/wall_changes.hpp"

namespace adit {
namespace {

constexpr double kNarrowest = 1.0;  // m: openings that walls are put into; double lines are nearer
constexpr double kWidest = 10.0;    // m
constexpr double kDeepest = 0.5;    // of an opening's width: what stubs and masonry take of it
constexpr double kShortest = 0.3;   // m: nothing shorter is added
constexpr int kTries = 200;         // for one wall

/// A point on a wall, and the opening before it.
struct Spot {
  Vector2d foot;
  Vector2d along;       ///< the wall's unit vector
  Vector2d across;      ///< unit, into the opening
  double width = 0.0;   ///< of the opening (m)
  double room_m = 0.0;  ///< of straight wall on both sides of the foot
};

class Builder {
 public:
  Builder(std::vector<Segment> walls, Random& random)
      : walls_(std::move(walls)), caster_(walls_), random_(random) {
    for (const Segment& wall : walls_) {
      reached_.push_back((reached_.empty() ? 0.0 : reached_.back()) + wall.length());
    }
  }

  /// At a random place of all walls; nothing where no opening of a usual width lies before it.
  std::optional<Spot> draw_spot() {
    const double at = random_.uniform(0.0, reached_.back());
    const auto i = static_cast<std::size_t>(
        std::upper_bound(reached_.begin(), reached_.end() - 1, at) - reached_.begin());
    const Segment& wall = walls_[i];
    const double length = wall.length();
    const double way = std::clamp(length - (reached_[i] - at), 0.0, length);
    const Vector2d along = (wall.b - wall.a) / length;
    Spot spot{wall.a + way * along, along, perpendicular(along), 0.0, std::min(way, length - way)};
    const double left = width(spot.foot, spot.across);
    const double right = width(spot.foot, -spot.across);
    // A plan does not say which side is rock. Openings are narrower than what stands between them.
    if (right < left) spot.across = -spot.across;
    spot.width = std::min(left, right);
    if (spot.width > kWidest) return std::nullopt;
    return spot;
  }

  /// A stopping, a stub or masonry, no longer than `most` metres.
  std::optional<WallChain> draw_wall(double most) {
    const std::optional<Spot> spot = draw_spot();
    const int kind = random_.below(3);
    if (!spot) return std::nullopt;
    if (kind == 0 && spot->width <= most) {
      return WallChain{{spot->foot, spot->foot + spot->width * spot->across}};
    }
    const double deepest = kDeepest * spot->width;
    if (kind == 1) {
      const double depth = std::min({random_.uniform(1.0, 3.0), deepest, most});
      if (depth < kShortest) return std::nullopt;
      return WallChain{{spot->foot, spot->foot + depth * spot->across}};
    }
    if (kind == 2) return masonry(*spot, std::min(deepest, random_.uniform(0.5, 1.5)), most);
    return std::nullopt;
  }

 private:
  /// Of the opening before a wall; infinity where it is narrower than an opening.
  double width(const Vector2d& foot, const Vector2d& across) const {
    const double range = caster_.range(foot, across, 1e3);
    return range >= kNarrowest ? range : std::numeric_limits<double>::infinity();
  }

  std::optional<WallChain> masonry(const Spot& spot, double depth, double most) const {
    const double half = std::min(spot.room_m, 1.5);
    if (depth < kShortest || half < kShortest || 2.0 * (depth + half) > most) return std::nullopt;
    const Vector2d front = depth * spot.across;
    const Vector2d side = half * spot.along;
    return WallChain{
        {spot.foot - side, spot.foot - side + front, spot.foot + side + front, spot.foot + side}};
  }

  std::vector<Segment> walls_;
  RayCaster caster_;
  Random& random_;
  std::vector<double> reached_;  // metres of wall up to and with each segment
};

}  // namespace

std::vector<WallChain> with_added(std::vector<WallChain> chains, double added_m,
                                  const WayClearance& way, Random& random) {
  if (chains.empty()) return chains;
  Builder builder(segments_of(chains), random);
  double budget = added_m;
  for (int tries = 0; budget > kShortest && tries < kTries; ++tries) {
    std::optional<WallChain> wall = builder.draw_wall(budget);
    if (!wall || !way.allows(*wall)) continue;
    budget -= wall->length();
    chains.push_back(std::move(*wall));
    tries = 0;
  }
  return chains;
}

}  // namespace adit
