#include <algorithm>
#include <cmath>

#include "adit/simulation/drive.hpp"
#include "parts.hpp"

namespace adit {
namespace {

constexpr std::uint64_t kWay = 63;  // stream of the seed

constexpr double kMetres = 60.0;
constexpr double kBefore = 15.0;     // until the machine is carried off (m)
constexpr double kAfter = 45.0;      // and then (m)
constexpr double kElsewhere = 10.0;  // (m)

double length_of(const std::vector<Pose2>& path) {
  double sum = 0.0;
  for (std::size_t i = 1; i < path.size(); ++i) {
    sum += (path[i].translation() - path[i - 1].translation()).norm();
  }
  return sum;
}

/// A part of the path of so many metres, from a random place where it is longer.
std::vector<Pose2> part_of(const std::vector<Pose2>& path, double metres, Random& random) {
  std::vector<double> way{0.0};
  for (std::size_t i = 1; i < path.size(); ++i) {
    way.push_back(way.back() + (path[i].translation() - path[i - 1].translation()).norm());
  }
  const double from = random.uniform(0.0, std::max(0.0, way.back() - metres));
  std::vector<Pose2> part;
  for (std::size_t i = 0; i < path.size(); ++i) {
    if (way[i] >= from && way[i] <= from + metres) part.push_back(path[i]);
  }
  return part;
}

/// A drive to random places; machines stop now and then.
Drive draw_way(const Cell& cell, const Ground& ground, double metres, Random& random) {
  constexpr std::uint64_t kSeeds = 1u << 30;
  if (!ground.ways.empty() && cell.task == Task::drive) {
    RandomDriveOptions options;
    options.length_m = metres;
    options.stops = cell.wheels == Wheels::creeping ? 3 : 0;
    return random_drive(ground.ways, options, random.bits() % kSeeds);
  }
  const bool is_carried = cell.start == Start::carried_off;
  const bool is_whole = !is_carried && (cell.task == Task::stops || cell.mine == Mine::crosscuts);
  const std::vector<Pose2>& path = ground.world.path;
  if (is_whole) return {path, {}};
  constexpr double kMostOfIt = 0.6;
  return {
      part_of(path, is_carried ? std::min(metres, kMostOfIt * length_of(path)) : metres, random),
      {}};
}

}  // namespace

bool choose_way(const Cell& cell, std::uint64_t seed, std::int64_t drive, Scene& scene) {
  constexpr int kTries = 100;
  Random random(seed, kWay);
  const Ground& ground = *scene.ground;
  const bool is_carried = cell.start == Start::carried_off;
  const auto draw = [&](double metres, int tried) {
    const std::size_t past_mark = static_cast<std::size_t>(drive) + static_cast<std::size_t>(tried);
    if (ground.drives.empty()) return draw_way(cell, ground, metres, random);
    return Drive{ground.drives[past_mark % ground.drives.size()], {}};
  };
  if (!is_carried) {
    Drive whole = draw(kMetres, 0);
    scene.path = std::move(whole.poses);
    scene.least_s = std::move(whole.least_s);
    return scene.path.size() > 1;
  }
  for (int i = 0; i < kTries; ++i) {
    scene.path = draw_way(cell, ground, kBefore, random).poses;
    scene.after = draw(kAfter, i).poses;
    if (scene.path.size() < 2 || scene.after.size() < 2) continue;
    const Vector2d hop = scene.after.front().translation() - scene.path.back().translation();
    if (hop.norm() >= kElsewhere) return true;
  }
  return false;
}

}  // namespace adit
