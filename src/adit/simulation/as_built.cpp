#include "adit/simulation/as_built.hpp"

#include <algorithm>
#include <cmath>

#include "adit/simulation/smooth_field.hpp"
#include "adit/simulation/wall_chains.hpp"
#include "adit/simulation/wall_changes.hpp"

namespace adit {
namespace {

// Streams of the seed.
constexpr std::uint64_t kBend = 31;
constexpr std::uint64_t kRough = 32;
constexpr std::uint64_t kDistortion = 33;
constexpr std::uint64_t kMissing = 34;
constexpr std::uint64_t kChains = 35;
constexpr std::uint64_t kAdded = 36;

constexpr double kCorner = kPi / 6.0;
constexpr double kPiecesInReach = 16.0;  // a piece bows by less than 1 % of sigma
constexpr double kRoughPiecesInReach = 6.0;
constexpr double kLongestPiece = 2.0;  // m

double distortion_sigma(const AsBuiltOptions& options) {
  return options.distortion * options.distortion_reach_m / std::sqrt(2.0);
}

bool moves(const AsBuiltOptions& options) {
  return options.bend_m > 0.0 || options.rough_m > 0.0 || options.distortion > 0.0;
}

/// Where the points of a plan stand in the mine.
class Movement {
 public:
  Movement(const AsBuiltOptions& options, std::uint64_t seed) {
    Random bend(seed, kBend);
    Random rough(seed, kRough);
    Random distortion(seed, kDistortion);
    bend_ = SmoothField(options.bend_m, options.reach_m, bend);
    rough_ = SmoothField(options.rough_m, options.rough_reach_m, rough);
    distortion_ = SmoothField(distortion_sigma(options), options.distortion_reach_m, distortion);
  }

  Vector2d smooth(const Vector2d& p) const { return p + bend_.at(p) + distortion_.at(p); }
  Vector2d wall(const Vector2d& p) const { return smooth(p) + rough_.at(p); }

  Pose2 pose(const Pose2& pose) const {
    constexpr double kStep = 0.05;  // m: short against any reach
    const Vector2d ahead = kStep * unit_vector(pose.theta);
    const Vector2d here = smooth(pose.translation());
    const Vector2d along = smooth(pose.translation() + ahead) - smooth(pose.translation() - ahead);
    // The turn alone is added, so that a heading keeps its turns.
    const double turn = std::atan2(cross(ahead, along), ahead.dot(along));
    return {here.x(), here.y(), pose.theta + turn};
  }

 private:
  SmoothField bend_;
  SmoothField rough_;
  SmoothField distortion_;
};

double piece_length(const AsBuiltOptions& options) {
  double piece = kLongestPiece;
  if (options.bend_m > 0.0) piece = std::min(piece, options.reach_m / kPiecesInReach);
  if (options.rough_m > 0.0) piece = std::min(piece, options.rough_reach_m / kRoughPiecesInReach);
  return piece;
}

bool changes_walls(const AsBuiltOptions& options) {
  return options.missing_ratio > 0.0 || options.added_ratio > 0.0 || options.chains_ratio > 0.0;
}

/// Walls gone, displaced and added, as chains, in the plan's place.
std::vector<WallChain> changed_walls(const World& world, const AsBuiltOptions& options,
                                     std::uint64_t seed) {
  std::vector<WallChain> chains = chains_of(world.walls, kCorner);
  double total = 0.0;
  for (const WallChain& chain : chains) total += chain.length();
  const WayClearance way{way_of(world.path), options.clearance_m};
  if (options.missing_ratio > 0.0) {
    Random random(seed, kMissing);
    chains = without_some(std::move(chains), options.missing_ratio * total, random);
  }
  if (options.chains_ratio > 0.0) {
    Random random(seed, kChains);
    chains = with_displaced(std::move(chains), options.chains_ratio * total, options.chain_offset_m,
                            way, random);
  }
  if (options.added_ratio > 0.0) {
    Random random(seed, kAdded);
    chains = with_added(std::move(chains), options.added_ratio * total, way, random);
  }
  return chains;
}

/// Where a line through the segment meets the circle, as fractions of the segment; none: from > to.
struct Crossing {
  double from = 1.0;
  double to = 0.0;
};

Crossing inside(const Segment& wall, const Vector2d& place, double radius) {
  const Vector2d along = wall.b - wall.a;
  const Vector2d from_place = wall.a - place;
  const double a = along.squaredNorm();
  const double b = along.dot(from_place);
  const double c = from_place.squaredNorm() - radius * radius;
  if (a == 0.0) return c < 0.0 ? Crossing{0.0, 1.0} : Crossing{};
  const double root = b * b - a * c;
  if (root <= 0.0) return {};
  return {std::max(0.0, (-b - std::sqrt(root)) / a), std::min(1.0, (-b + std::sqrt(root)) / a)};
}

}  // namespace

World as_built(World planned, const AsBuiltOptions& options, std::uint64_t seed) {
  if (!moves(options) && !changes_walls(options)) return planned;
  std::vector<WallChain> chains = changed_walls(planned, options, seed);
  if (moves(options)) {
    const Movement movement(options, seed);
    for (WallChain& chain : chains) {
      chain = densified(chain, piece_length(options));
      for (Vector2d& point : chain.points) point = movement.wall(point);
    }
    for (Pose2& pose : planned.path) pose = movement.pose(pose);
  }
  planned.walls = segments_of(chains);
  return planned;
}

double long_plan_error(const AsBuiltOptions& options) {
  return std::hypot(options.bend_m, distortion_sigma(options),
                    options.chain_offset_m * std::sqrt(options.chains_ratio));
}

World off_plan(World world, const Vector2d& place, double radius) {
  std::vector<Segment> left;
  for (const Segment& wall : world.plan) {
    const Crossing cut = inside(wall, place, radius);
    if (cut.from >= cut.to) {
      left.push_back(wall);
      continue;
    }
    const Vector2d along = wall.b - wall.a;
    if (cut.from > 0.0) left.push_back({wall.a, wall.a + cut.from * along});
    if (cut.to < 1.0) left.push_back({wall.a + cut.to * along, wall.b});
  }
  world.plan = std::move(left);
  return world;
}

}  // namespace adit
