#include "adit/simulation/drive.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <utility>

#include "adit/simulation/drive_line.hpp"
#include "adit/simulation/drive_route.hpp"
#include "adit/simulation/random.hpp"

namespace adit {
namespace {

// Streams of the seed.
constexpr std::uint64_t kPlaces = 31;
constexpr std::uint64_t kPauses = 32;

constexpr double kToSpare = 1.3;  // ways are shorter once their corners are round
constexpr double kBehind = 4.0;   // m: no leg begins by going back over these
constexpr double kDeadEnd = 6.0;  // m: where it goes on for less, the machine turns back
constexpr int kMostLegs = 10000;

using Line = std::vector<Vector2d>;

double length_of(const Line& line) {
  double sum = 0.0;
  for (std::size_t i = 1; i < line.size(); ++i) sum += (line[i] - line[i - 1]).norm();
  return sum;
}

/// Places that lie behind a machine that comes by this line.
std::vector<bool> places_behind(const DriveMap& map, const Line& line) {
  if (line.size() < 2) return {};
  const Vector2d& at = line.back();
  auto before = line.end() - 1;
  while (before != line.begin() && (*before - at).norm() < 0.5 * kBehind) --before;
  const Vector2d ahead = (at - *before).normalized();
  std::vector<bool> behind(map.size());
  for (std::size_t i = 0; i < map.size(); ++i) {
    const Vector2d off = map.place(i) - at;
    behind[i] = off.norm() < kBehind && off.dot(ahead) < -0.2 * off.norm();
  }
  return behind;
}

/// One of the farther half of the places that are reached.
int choose_place(const DriveRoutes& routes, double farthest, double wanted, Random& random) {
  const double least = std::min(wanted, 0.5 * farthest);
  std::vector<int> choices;
  std::copy_if(routes.reached().begin(), routes.reached().end(), std::back_inserter(choices),
               [&](int place) { return routes.metres(place) >= least; });
  return choices[static_cast<std::size_t>(random.below(static_cast<int>(choices.size())))];
}

double farthest_of(const DriveRoutes& routes) {
  double farthest = 0.0;
  for (const int place : routes.reached()) farthest = std::max(farthest, routes.metres(place));
  return farthest;
}

/// Lines from place to place, so long together. Each but the first begins where the one before has
/// ended, at a dead end.
std::vector<Line> random_lines(const DriveMap& map, Line first, int place, double length,
                               Random& random) {
  std::vector<Line> lines = {std::move(first)};
  double left = length - length_of(lines.back());
  for (int leg = 0; leg < kMostLegs && left > 0.0; ++leg) {
    const double most = std::max(left, 2.0 * kDeadEnd);
    DriveRoutes routes(map, place, most, places_behind(map, lines.back()));
    double farthest = farthest_of(routes);
    if (farthest < kDeadEnd && lines.back().size() > 1) {
      lines.push_back({lines.back().back()});
      routes = DriveRoutes(map, place, most);
      farthest = farthest_of(routes);
    }
    if (farthest <= 0.0) break;
    place = choose_place(routes, farthest, left, random);
    for (const int on_way : routes.way_to(place)) {
      const Vector2d& next = map.place(static_cast<std::size_t>(on_way));
      if (next == lines.back().back()) continue;
      left -= (next - lines.back().back()).norm();
      lines.back().push_back(next);
    }
  }
  return lines;
}

/// Poses along a line, headings along it, until so many metres are driven.
void append(const Line& line, double& left, Drive& drive) {
  for (std::size_t i = 0; i < line.size() && line.size() > 1; ++i) {
    const Vector2d& before = line[i > 0 ? i - 1 : i];
    const Vector2d& after = line[i + 1 < line.size() ? i + 1 : i];
    const double step = (line[i] - before).norm();
    const Vector2d along = after - before;
    const Vector2d at =
        step > left ? Vector2d(before + (line[i] - before) * (left / step)) : line[i];
    drive.poses.push_back({at.x(), at.y(), std::atan2(along.y(), along.x())});
    drive.least_s.push_back(0.0);
    left -= step;
    if (left <= 0.0) return;
  }
}

/// What befalls the machine at one pose of its drive.
enum class Pause { stop, turn, creep };

struct PlacedPause {
  std::size_t pose;
  Pause kind;
  double size;
};

void add_pause(const PlacedPause& pause, const Pose2& from, const RandomDriveOptions& options,
               Drive& out) {
  const Pose2 at = out.poses.back();
  switch (pause.kind) {
    case Pause::stop:
      out.poses.push_back(at);
      out.least_s.push_back(options.stop_s * pause.size);
      return;
    case Pause::turn:
      for (int quarter = 1; quarter <= 4; ++quarter) {
        const double turned = std::copysign(0.5 * kPi * quarter, pause.size - 1.0);
        out.poses.push_back({at.x, at.y, quarter == 4 ? at.theta : wrap_angle(at.theta + turned)});
        out.least_s.push_back(0.0);
      }
      return;
    case Pause::creep:
      out.least_s.back() = (at.translation() - from.translation()).norm() / options.creep_m_per_s;
      return;
  }
}

/// The drive with its stops, turns on the spot and creeps at random poses.
Drive with_pauses(const Drive& drive, const RandomDriveOptions& options, std::uint64_t seed) {
  Random random(seed, kPauses);
  std::vector<PlacedPause> pauses;
  const auto place = [&](Pause kind, int count) {
    for (int i = 0; i < count && drive.poses.size() > 1; ++i) {
      const int pose = 1 + random.below(static_cast<int>(drive.poses.size()) - 1);
      pauses.push_back({static_cast<std::size_t>(pose), kind, random.uniform(0.5, 1.5)});
    }
  };
  place(Pause::stop, options.stops);
  place(Pause::turn, options.turns);
  place(Pause::creep, options.creeps);
  // A creep is of the move to its pose, before what is done there.
  std::stable_sort(pauses.begin(), pauses.end(), [](const PlacedPause& a, const PlacedPause& b) {
    return std::pair(a.pose, a.kind != Pause::creep) < std::pair(b.pose, b.kind != Pause::creep);
  });
  Drive out;
  auto next = pauses.begin();
  for (std::size_t i = 0; i < drive.poses.size(); ++i) {
    out.poses.push_back(drive.poses[i]);
    out.least_s.push_back(drive.least_s[i]);
    for (; next != pauses.end() && next->pose == i; ++next) {
      add_pause(*next, drive.poses[i > 0 ? i - 1 : 0], options, out);
    }
  }
  return out;
}

}  // namespace

double Drive::length_m() const {
  double sum = 0.0;
  for (std::size_t i = 1; i < poses.size(); ++i) {
    sum += (poses[i].translation() - poses[i - 1].translation()).norm();
  }
  return sum;
}

TimedPath timed(const Drive& drive, double speed, double turn_rate) {
  TimedPath path;
  for (std::size_t i = 0; i < drive.poses.size(); ++i) {
    const Pose2& pose = drive.poses[i];
    if (path.knots.empty()) {
      path.knots.push_back({0.0, pose});
      continue;
    }
    const StampedPose& last = path.knots.back();
    const double metres = (pose.translation() - last.pose.translation()).norm();
    const double turn = std::abs(angle_between(last.pose.theta, pose.theta));
    const double least = i < drive.least_s.size() ? drive.least_s[i] : 0.0;
    const double seconds = std::max({metres / speed, turn / turn_rate, least});
    if (seconds > 0.0) path.knots.push_back({last.stamp + seconds, pose});
  }
  return path;
}

Drive random_drive(const DriveMap& map, const RandomDriveOptions& options, std::uint64_t seed,
                   const std::optional<Pose2>& start) {
  Drive drive;
  if (map.empty()) return drive;
  Random random(seed, kPlaces);
  int place = random.below(static_cast<int>(map.size()));
  Line first;
  if (start) {
    place = map.place_near(start->translation());
    if (place < 0) return drive;
    first.push_back(start->translation());
    drive.poses.push_back(*start);
    drive.least_s.push_back(0.0);
  }
  if (first.empty() || map.place(static_cast<std::size_t>(place)) != first.front()) {
    first.push_back(map.place(static_cast<std::size_t>(place)));
  }
  double left = options.length_m;
  for (const Line& line :
       random_lines(map, std::move(first), place, kToSpare * options.length_m, random)) {
    if (left > 0.0) append(smoothed(map, line, options.step_m), left, drive);
  }
  return with_pauses(drive, options, seed);
}

Drive drive_between(const DriveMap& map, const Vector2d& from, const Vector2d& to, double step_m) {
  Drive drive;
  const int first = map.place_near(from);
  const int last = map.place_near(to);
  if (first < 0 || last < 0) return drive;
  const DriveRoutes routes(map, first, std::numeric_limits<double>::infinity());
  const std::vector<int> way = routes.way_to(last);
  if (way.empty() && first != last) return drive;
  Line line = {from};
  for (const int place : way) {
    const Vector2d& next = map.place(static_cast<std::size_t>(place));
    if (next != line.back()) line.push_back(next);
  }
  if (to != line.back()) line.push_back(to);
  double left = std::numeric_limits<double>::infinity();
  append(smoothed(map, line, step_m), left, drive);
  return drive;
}

}  // namespace adit
