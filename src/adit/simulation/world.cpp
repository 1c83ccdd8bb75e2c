#include "adit/simulation/world.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace adit {
namespace {

constexpr int kPersonSides = 8;

/// How far along its beat a person is who turns round at both ends, in [0, 1].
double pacing_fraction(const Person& person, double stamp) {
  const double beat = (person.to - person.from).norm();
  if (person.speed <= 0.0 || beat <= 0.0) return 0.0;
  const double laps = stamp * person.speed / beat;
  const double phase = laps - 2.0 * std::floor(laps / 2.0);
  return phase <= 1.0 ? phase : 2.0 - phase;
}

}  // namespace

std::vector<Segment> fixed_segments(const World& world) {
  std::vector<Segment> all = world.walls;
  all.insert(all.end(), world.clutter.begin(), world.clutter.end());
  return all;
}

std::vector<Segment> people_at(const World& world, double stamp) {
  std::vector<Segment> all;
  for (const Person& person : world.people) {
    const Vector2d center =
        person.from + pacing_fraction(person, stamp) * (person.to - person.from);
    std::array<Vector2d, kPersonSides> corners;
    for (int i = 0; i < kPersonSides; ++i) {
      corners[static_cast<std::size_t>(i)] =
          center + 0.5 * person.diameter * unit_vector(kTwoPi * i / kPersonSides);
    }
    const std::vector<Segment> body = outline(corners);
    all.insert(all.end(), body.begin(), body.end());
  }
  return all;
}

std::vector<Segment> movers_at(const World& world, double stamp) {
  std::vector<Segment> all;
  for (const Mover& mover : world.movers) {
    if (mover.way.knots.empty() || stamp < mover.way.begin() || stamp > mover.way.end()) continue;
    const Pose2 pose = mover.way.at(stamp);
    std::vector<Vector2d> corners;
    for (const Vector2d& corner : mover.body) corners.push_back(pose * corner);
    const std::vector<Segment> body = outline(corners);
    all.insert(all.end(), body.begin(), body.end());
  }
  return all;
}

std::vector<Segment> passing_segments(const World& world, const StampedPose& map_from_vehicle) {
  std::vector<Segment> all = people_at(world, map_from_vehicle.stamp);
  const std::vector<Segment> movers = movers_at(world, map_from_vehicle.stamp);
  all.insert(all.end(), movers.begin(), movers.end());
  for (const Ramp& ramp : world.ramps) {
    const std::vector<Segment> cuts = cuts_of(ramp, map_from_vehicle.pose.translation());
    all.insert(all.end(), cuts.begin(), cuts.end());
  }
  return all;
}

std::vector<Segment> outline(std::span<const Vector2d> points) {
  std::vector<Segment> closed;
  closed.reserve(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    closed.push_back({points[i], points[(i + 1) % points.size()]});
  }
  return closed;
}

double plan_error(const World& world) {
  if (world.walls.empty() || world.plan.empty()) return 0.0;
  const auto same = [](const Segment& s, const Segment& t) { return s.a == t.a && s.b == t.b; };
  if (std::equal(world.walls.begin(), world.walls.end(), world.plan.begin(), world.plan.end(),
                 same))
    return 0.0;
  double sum = 0.0;
  for (const Segment& wall : world.walls) {
    const Vector2d middle = 0.5 * (wall.a + wall.b);
    double nearest = std::numeric_limits<double>::infinity();
    for (const Segment& planned : world.plan)
      nearest = std::min(nearest, distance(planned, middle));
    sum += nearest * nearest;
  }
  return std::sqrt(sum / static_cast<double>(world.walls.size()));
}

World from_plan(std::vector<Segment> segments) {
  World world;
  world.walls = segments;
  world.plan = std::move(segments);
  return world;
}

}  // namespace adit
