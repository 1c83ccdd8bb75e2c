#include "parts.hpp"

namespace adit {
namespace {

constexpr std::uint64_t kLasting = 64;  // stream of the seed

/// The moves from scan to scan, each made another; what was lost stays lost.
template <class Change>
void change_moves(std::vector<Pose2>& odometry, Change&& change) {
  const std::vector<Pose2> before = odometry;
  for (std::size_t i = 1; i < before.size(); ++i) {
    odometry[i] = odometry[i - 1] * change(inverse(before[i - 1]) * before[i]);
  }
}

}  // namespace

OdometryNoise noise_of(Wheels wheels) {
  if (wheels == Wheels::paper) return mockup_odometry();
  OdometryNoise noise;
  noise.translation_sigma_ratio = 0.02;
  noise.rotation_sigma_rad_per_m = radians(0.5);
  noise.rotation_sigma_ratio = 0.0;
  noise.translation_floor_m = 0.0;
  noise.rotation_floor_rad = 0.0;
  return noise;
}

void spoil_wheels(const Cell& cell, std::uint64_t seed, Scene& scene) {
  Random random(seed, kLasting);
  std::vector<Pose2>& odometry = scene.recording.odometry;
  const double scale = 1.0 + 0.01 * random.normal();
  const double turn = 1.0 + 0.01 * random.normal();
  if (cell.wheels != Wheels::paper) {
    change_moves(odometry, [&](const Pose2& move) {
      return Pose2{scale * move.x, scale * move.y, turn * move.theta};
    });
  }
  scene.odometry.assign(odometry.begin(), odometry.end());
  if (cell.wheels == Wheels::none) {
    scene.odometry.assign(odometry.size(), std::nullopt);
  }
}

}  // namespace adit
