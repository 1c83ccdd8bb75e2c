#include "adit/simulation/clutter.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "adit/simulation/random.hpp"
#include "adit/simulation/ray_caster.hpp"
#include "adit/simulation/way.hpp"

namespace adit {
namespace {

constexpr int kTries = 400;            // for one piece
constexpr double kWalkingSpeed = 1.2;  // m/s
constexpr std::uint64_t kClutterStream = 3;

/// A round place that something takes up; a beat of somebody who paces is a long one.
struct Place {
  Segment middle;
  double radius = 0.0;
};

class Placer {
 public:
  Placer(const World& world, const ClutterOptions& options, Random& random)
      : world_(world), options_(options), random_(random), way_(way_of(world.path)) {}

  /// A point somewhere beside the way, free or not.
  Vector2d draw_point() {
    const int count = static_cast<int>(world_.path.size());
    const Vector2d from = world_.path[static_cast<std::size_t>(random_.below(count))].translation();
    const double angle = random_.uniform(-kPi, kPi);
    return from +
           random_.uniform(options_.path_clearance_m, options_.spread_m) * unit_vector(angle);
  }

  bool is_free(const Place& place) const {
    const auto near = [&](const Segment& s, double clearance) {
      return distance_between(place.middle, s) < place.radius + clearance;
    };
    for (const Segment& link : way_) {
      if (near(link, options_.path_clearance_m)) return false;
    }
    for (const Place& taken : taken_) {
      if (near(taken.middle, taken.radius)) return false;
    }
    for (const Segment& wall : world_.walls) {
      if (near(wall, options_.wall_clearance_m)) return false;
    }
    return in_sight(place.middle.a);
  }

  void take(const Place& place) { taken_.push_back(place); }

 private:
  /// Whether some pose of the way sees the point: it lies in an opening, not in rock.
  bool in_sight(const Vector2d& point) const {
    return std::any_of(way_.begin(), way_.end(), [&](const Segment& link) {
      const Vector2d to_point = point - link.a;
      const double range = to_point.norm();
      return range <= options_.spread_m && cast_ray(world_.walls, link.a, to_point / range) > range;
    });
  }

  const World& world_;
  const ClutterOptions& options_;
  Random& random_;
  std::vector<Segment> way_;
  std::vector<Place> taken_;
};

std::vector<Segment> box_outline(const Vector2d& center, const Vector2d& size, double turn) {
  const Vector2d along = 0.5 * size.x() * unit_vector(turn);
  const Vector2d across = 0.5 * size.y() * perpendicular(unit_vector(turn));
  const std::array<Vector2d, 4> corners{center - along - across, center + along - across,
                                        center + along + across, center - along + across};
  return outline(corners);
}

bool add_box(World& world, const ClutterOptions& options, Placer& placer, Random& random) {
  for (int i = 0; i < kTries; ++i) {
    const Vector2d size{random.uniform(options.box_min_m, options.box_max_m),
                        random.uniform(options.box_min_m, options.box_max_m)};
    const double turn = random.uniform(-kPi, kPi);
    const Vector2d center = placer.draw_point();
    const Place place{{center, center}, 0.5 * size.norm()};
    if (!placer.is_free(place)) continue;
    placer.take(place);
    const std::vector<Segment> box = box_outline(center, size, turn);
    world.clutter.insert(world.clutter.end(), box.begin(), box.end());
    return true;
  }
  return false;
}

bool add_person(World& world, bool walks, Placer& placer, Random& random) {
  for (int i = 0; i < kTries; ++i) {
    const double diameter = random.uniform(0.4, 0.5);
    const Vector2d from = placer.draw_point();
    const Vector2d to = walks ? placer.draw_point() : from;
    const Place place{{from, to}, 0.5 * diameter};
    if (!placer.is_free(place)) continue;
    placer.take(place);
    const Person person{from, to, walks ? kWalkingSpeed : 0.0, diameter};
    if (walks) {
      world.people.push_back(person);
    } else {
      World alone;
      alone.people.push_back(person);
      const std::vector<Segment> body = people_at(alone, 0.0);
      world.clutter.insert(world.clutter.end(), body.begin(), body.end());
    }
    return true;
  }
  return false;
}

}  // namespace

ClutterOptions clutter_of(int pieces) {
  ClutterOptions options;
  options.boxes = (5 * pieces + 4) / 8;
  options.people = pieces - options.boxes;
  return options;
}

int add_clutter(World& world, const ClutterOptions& options, std::uint64_t seed) {
  if (world.path.empty()) return 0;
  Random random(seed, kClutterStream);
  Placer placer(world, options, random);
  int placed = 0;
  for (int i = 0; i < options.boxes; ++i) placed += add_box(world, options, placer, random);
  for (int i = 0; i < options.people; ++i) placed += add_person(world, false, placer, random);
  for (int i = 0; i < options.walkers; ++i) placed += add_person(world, true, placer, random);
  return placed;
}

}  // namespace adit
