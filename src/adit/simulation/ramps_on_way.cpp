#include "adit/simulation/ramps_on_way.hpp"

#include <algorithm>

#include "adit/simulation/random.hpp"
#include "adit/simulation/ray_caster.hpp"

namespace adit {
namespace {

constexpr std::uint64_t kStream = 38;  // of the seed
constexpr int kTries = 100;            // for one ramp
constexpr double kShortest = 8.0;      // m
constexpr double kLongest = 20.0;      // m
constexpr double kWidest = 12.0;       // m

/// A ramp from this pose on along the heading; width 0 where there is no opening for one.
Ramp draw_ramp(const RayCaster& walls, const Pose2& pose, Random& random) {
  const Vector2d place = pose.translation();
  const Vector2d ahead = unit_vector(pose.theta);
  const Vector2d aside = perpendicular(ahead);
  const double left = walls.range(place, aside, kWidest);
  const double right = walls.range(place, -aside, kWidest);
  Ramp ramp;
  ramp.length_m = std::min(random.uniform(kShortest, kLongest), walls.range(place, ahead));
  ramp.slope_rad = random.uniform(radians(5.0), radians(9.0));
  ramp.width_m = left + right <= kWidest && ramp.length_m >= kShortest ? left + right : 0.0;
  const bool falls = random.chance(0.5);
  const Vector2d middle = place + 0.5 * (left - right) * aside;
  ramp.heading = falls ? wrap_angle(pose.theta + kPi) : pose.theta;
  ramp.foot = falls ? Vector2d(middle + ramp.length_m * ahead) : middle;
  return ramp;
}

Vector2d middle_of(const Ramp& ramp) {
  return ramp.foot + 0.5 * ramp.length_m * unit_vector(ramp.heading);
}

}  // namespace

int lay_ramps(World& world, int count, std::uint64_t seed) {
  if (world.path.empty()) return 0;
  Random random(seed, kStream);
  const RayCaster walls(world.walls);
  const int before = static_cast<int>(world.ramps.size());
  for (int i = 0; i < count; ++i) {
    for (int tries = 0; tries < kTries; ++tries) {
      const auto at = static_cast<std::size_t>(random.below(static_cast<int>(world.path.size())));
      const Ramp ramp = draw_ramp(walls, world.path[at], random);
      const bool is_apart =
          std::all_of(world.ramps.begin(), world.ramps.end(), [&](const Ramp& other) {
            return (middle_of(other) - middle_of(ramp)).norm() > kLongest + kWidest;
          });
      if (ramp.width_m <= 0.0 || !is_apart) continue;
      world.ramps.push_back(ramp);
      break;
    }
  }
  return static_cast<int>(world.ramps.size()) - before;
}

}  // namespace adit
