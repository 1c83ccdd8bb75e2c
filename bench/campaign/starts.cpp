#include "parts.hpp"

namespace adit {
namespace {

constexpr std::uint64_t kStart = 65;  // stream of the seed

}  // namespace

bool choose_start(const Cell& cell, std::uint64_t seed, Scene& scene) {
  constexpr int kTries = 500;
  constexpr double kElsewhere = 3.0;  // m
  if (cell.start == Start::anywhere) return true;
  scene.start = scene.recording.first_guess;
  if (cell.start != Start::typed_wrong) return true;
  Random random(seed, kStart);
  const std::vector<Pose2>& places = scene.ground->places;
  const Vector2d truth = scene.recording.truth.front().pose.translation();
  for (int i = 0; i < kTries; ++i) {
    const Pose2& place =
        places[static_cast<std::size_t>(random.below(static_cast<int>(places.size())))];
    if ((place.translation() - truth).norm() < kElsewhere) continue;
    scene.start->pose = {place.x, place.y, random.uniform(-kPi, kPi)};
    return true;
  }
  return false;
}

}  // namespace adit
