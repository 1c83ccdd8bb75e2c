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

/// A part of the path of so many metres, or of most of it, from a random place.
std::vector<Pose2> part_of(const std::vector<Pose2>& path, double metres, Random& random) {
  std::vector<double> way{0.0};
  for (std::size_t i = 1; i < path.size(); ++i) {
    way.push_back(way.back() + (path[i].translation() - path[i - 1].translation()).norm());
  }
  metres = std::min(metres, 0.6 * way.back());
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
  return {is_whole ? ground.world.path : part_of(ground.world.path, metres, random), {}};
}

}  // namespace

bool choose_way(const Cell& cell, std::uint64_t seed, std::int64_t drive, Scene& scene) {
  constexpr int kTries = 100;
  Random random(seed, kWay);
  const Ground& ground = *scene.ground;
  const bool is_carried = cell.start == Start::carried_off;
  Drive first = draw_way(cell, ground, is_carried ? kBefore : kMetres, random);
  scene.path = std::move(first.poses);
  scene.least_s = std::move(first.least_s);
  const auto marked = static_cast<std::size_t>(drive);
  const bool has_drives = !ground.drives.empty();
  if (!is_carried) {
    if (has_drives) {
      scene.path = ground.drives[marked % ground.drives.size()];
      scene.least_s.clear();
    }
    return scene.path.size() > 1;
  }
  for (int i = 0; i < kTries; ++i) {
    scene.after = has_drives
                      ? ground.drives[(marked + static_cast<std::size_t>(i)) % ground.drives.size()]
                      : draw_way(cell, ground, kAfter, random).poses;
    if (scene.after.size() < 2 || scene.path.size() < 2) return false;
    const Vector2d hop = scene.after.front().translation() - scene.path.back().translation();
    if (hop.norm() >= kElsewhere) return true;
  }
  return false;
}

}  // namespace adit
