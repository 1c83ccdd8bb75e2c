#include <algorithm>
#include <cmath>

#include "parts.hpp"

namespace adit {
namespace {

constexpr std::uint64_t kWay = 63;  // stream of the seed

constexpr double kMetres = 60.0;
constexpr double kBefore = 15.0;     // until the machine is carried off (m)
constexpr double kAfter = 45.0;      // and then (m)
constexpr double kElsewhere = 10.0;  // (m)

const Pose2& any_of(const std::vector<Pose2>& places, Random& random) {
  return places[static_cast<std::size_t>(random.below(static_cast<int>(places.size())))];
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

/// Mines through which the machine drives where it likes; in the others it has a path.
bool is_roamed(Mine mine) {
  return mine == Mine::niosh || mine == Mine::edgar || mine == Mine::regular_panel ||
         mine == Mine::gap_panel || mine == Mine::entry_panel;
}

std::vector<Pose2> draw_way(const Cell& cell, const Ground& ground, double metres, Random& random) {
  if (is_roamed(cell.mine)) return roam(ground.caster, any_of(ground.places, random), metres);
  const bool is_whole = cell.task == Task::stops || cell.mine == Mine::crosscuts;
  return is_whole ? ground.world.path : part_of(ground.world.path, metres, random);
}

}  // namespace

std::vector<Pose2> roam(const RayCaster& walls, const Pose2& start, double metres) {
  constexpr double kStep = 0.5;
  constexpr double kLook = 15.0;
  constexpr double kAhead = 3.0;  // m of room that need no turn
  constexpr double kAside = 1.0;  // m
  constexpr std::size_t kMostPoses = 1000;
  std::vector<Pose2> path = {start};
  const auto room = [&](const Vector2d& from, double heading) {
    return walls.range(from, unit_vector(heading), kLook);
  };
  while (kStep * static_cast<double>(path.size()) < metres && path.size() < kMostPoses) {
    const Pose2& at = path.back();
    double best = 0.0;
    double most = -1.0;
    for (int i = -18; i <= 18; ++i) {
      const double turn = radians(5.0 * i);
      const double ahead = std::min(room(at.translation(), at.theta + turn), kLook);
      const double aside = std::min({room(at.translation(), at.theta + turn + 0.5),
                                     room(at.translation(), at.theta + turn - 0.5), 2.0 * kAside});
      const double value = std::min(ahead, kAhead) + 0.1 * ahead + aside - 0.8 * std::abs(turn);
      if (value <= most) continue;
      most = value;
      best = turn;
    }
    const double heading = wrap_angle(at.theta + std::clamp(best, -0.4, 0.4));
    const Vector2d next = at.translation() + kStep * unit_vector(heading);
    const bool is_blocked = room(at.translation(), heading) < kStep + 0.5;
    path.push_back(is_blocked ? Pose2{at.x, at.y, wrap_angle(at.theta + 0.4)}
                              : Pose2{next.x(), next.y(), heading});
  }
  return path;
}

bool choose_way(const Cell& cell, std::uint64_t seed, std::int64_t drive, Scene& scene) {
  constexpr int kTries = 100;
  Random random(seed, kWay);
  const Ground& ground = *scene.ground;
  const bool is_carried = cell.start == Start::carried_off;
  scene.path = draw_way(cell, ground, is_carried ? kBefore : kMetres, random);
  const auto marked = static_cast<std::size_t>(drive);
  const bool has_drives = !ground.drives.empty();
  if (!is_carried) {
    if (has_drives) scene.path = ground.drives[marked % ground.drives.size()];
    return scene.path.size() > 1;
  }
  for (int i = 0; i < kTries; ++i) {
    scene.after = has_drives
                      ? ground.drives[(marked + static_cast<std::size_t>(i)) % ground.drives.size()]
                      : draw_way(cell, ground, kAfter, random);
    const Vector2d hop = scene.after.front().translation() - scene.path.back().translation();
    if (hop.norm() >= kElsewhere) return true;
  }
  return false;
}

}  // namespace adit
