#include "adit/simulation/wall_clutter.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "adit/simulation/random.hpp"
#include "adit/simulation/ray_caster.hpp"
#include "adit/simulation/way.hpp"

namespace adit {
namespace {

constexpr int kTries = 400;               // for one piece
constexpr std::uint64_t kStream = 37;     // of the seed
constexpr double kLooseGap = 0.05;        // m: between a wall and what stands at it, at most
constexpr double kWalkingSpeed = 1.2;     // m/s
constexpr double kPersonDiameter = 0.45;  // m

/// A place at a wall that is seen from the way.
struct Spot {
  Vector2d foot;
  Vector2d along;  ///< the wall's unit vector
  Vector2d out;    ///< unit, towards the way
};

/// A rectangle: `size` along and across.
struct Box {
  Vector2d center;
  Vector2d along;  ///< unit
  Vector2d size;
};

std::vector<Segment> sides(const Box& box) {
  const Vector2d along = 0.5 * box.size.x() * box.along;
  const Vector2d across = 0.5 * box.size.y() * perpendicular(box.along);
  const std::array<Vector2d, 4> corners{box.center - along - across, box.center + along - across,
                                        box.center + along + across, box.center - along + across};
  return outline(corners);
}

class Stacker {
 public:
  Stacker(World& world, const WallClutterOptions& options, std::uint64_t seed)
      : world_(world),
        options_(options),
        random_(seed, kStream),
        walls_(world.walls),
        way_(way_of(world.path)) {}

  bool add_against() {
    return try_often([&](const Spot& spot) { return put(at_wall(spot, {side(), side()})); });
  }

  bool add_piercing() {
    return try_often([&](const Spot& spot) {
      const Vector2d size(side(), side());
      const double deep = random_.uniform(-0.25, 0.25) * size.minCoeff();
      return put({spot.foot + deep * spot.out, unit_vector(random_.uniform(-kPi, kPi)), size});
    });
  }

  bool add_along() {
    return try_often([&](const Spot& spot) {
      const double length = random_.uniform(options_.run_min_m, options_.run_max_m);
      return put(at_wall(spot, {length, random_.uniform(0.4, 0.8)}));
    });
  }

  /// Boxes on both sides of a stretch of the way.
  bool add_row() {
    const std::size_t first = draw_pose();
    double way = 0.0;
    double next = 0.0;
    int boxes = 0;
    for (std::size_t i = first; i < world_.path.size() && way <= options_.row_m; ++i) {
      if (i > first) {
        way += (world_.path[i].translation() - world_.path[i - 1].translation()).norm();
      }
      if (way < next) continue;
      for (const double turn : {0.5 * kPi, -0.5 * kPi}) {
        const std::optional<Spot> spot = look(world_.path[i], turn);
        if (spot && put(at_wall(*spot, {side(), side()}))) ++boxes;
      }
      next = way + random_.uniform(options_.box_min_m, options_.box_max_m);
    }
    return boxes > 0;
  }

  /// Three people side by side and one after the other, on one side of the way.
  bool add_group() {
    for (int i = 0; i < kTries; ++i) {
      const Pose2& pose = world_.path[draw_pose()];
      const Vector2d ahead = unit_vector(pose.theta);
      const Vector2d aside = (random_.chance(0.5) ? 1.0 : -1.0) * perpendicular(ahead);
      const Vector2d from = pose.translation() + (options_.path_clearance_m + 0.5) * aside;
      const Vector2d beat = random_.uniform(6.0, 12.0) * ahead;
      const std::array<Vector2d, 3> places{from, from + 0.7 * ahead + 0.3 * aside,
                                           from + 1.4 * ahead};
      const bool all_walk = std::all_of(places.begin(), places.end(), [&](const Vector2d& place) {
        return is_reached(pose.translation(), place) && can_walk({place, place + beat});
      });
      if (!all_walk) continue;
      for (const Vector2d& place : places) {
        world_.people.push_back({place, place + beat, kWalkingSpeed, kPersonDiameter});
      }
      return true;
    }
    return false;
  }

 private:
  std::size_t draw_pose() {
    return static_cast<std::size_t>(random_.below(static_cast<int>(world_.path.size())));
  }

  double side() { return random_.uniform(options_.box_min_m, options_.box_max_m); }

  /// The wall that is met at this angle to the heading; its line is that through the points a
  /// little to both sides, so that a rough wall has the direction of the whole.
  std::optional<Spot> look(const Pose2& from, double angle) const {
    constexpr double kBeside = 0.5;  // m
    const Vector2d eye = from.translation();
    const auto meet = [&](double turn) -> Vector2d {
      const Vector2d direction = unit_vector(from.theta + angle + turn);
      return eye + walls_.range(eye, direction, 2.0 * options_.spread_m) * direction;
    };
    const Vector2d foot = meet(0.0);
    const double range = (foot - eye).norm();
    if (!(range <= options_.spread_m) || range == 0.0) return std::nullopt;
    const double turn = std::atan2(kBeside, range);
    const Vector2d chord = meet(turn) - meet(-turn);
    if (!(chord.norm() <= 6.0 * kBeside)) return std::nullopt;  // seen over an edge, or too flat
    const Vector2d along = chord.normalized();
    const Vector2d normal = perpendicular(along);
    return Spot{foot, along, normal.dot(eye - foot) > 0.0 ? normal : Vector2d(-normal)};
  }

  /// Size along the wall and out of it.
  Box at_wall(const Spot& spot, const Vector2d& size) {
    const double out = 0.5 * size.y() + random_.uniform(0.0, kLooseGap);
    return {spot.foot + out * spot.out, spot.along, size};
  }

  bool put(const Box& box) {
    const std::vector<Segment> all = sides(box);
    const bool is_clear = std::all_of(all.begin(), all.end(), [&](const Segment& s) {
      return is_clear_of(way_, s, options_.path_clearance_m);
    });
    if (is_clear) world_.clutter.insert(world_.clutter.end(), all.begin(), all.end());
    return is_clear;
  }

  template <class Place>
  bool try_often(Place&& place) {
    for (int i = 0; i < kTries; ++i) {
      const Pose2& from = world_.path[draw_pose()];
      const std::optional<Spot> spot = look(from, random_.uniform(-kPi, kPi));
      if (spot && place(*spot)) return true;
    }
    return false;
  }

  /// Whether no wall lies between the eye and a body there.
  bool is_reached(const Vector2d& eye, const Vector2d& place) const {
    const Vector2d to_place = place - eye;
    const double most = to_place.norm() + kPersonDiameter;
    return !std::isfinite(walls_.range(eye, to_place.normalized(), most));
  }

  /// Whether a body passes from end to end.
  bool can_walk(const Segment& beat) const {
    if (!is_clear_of(way_, beat, options_.path_clearance_m + 0.5 * kPersonDiameter)) return false;
    const Vector2d along = (beat.b - beat.a).normalized();
    const double most = beat.length() + kPersonDiameter;
    const std::array<double, 3> lanes{-0.6, 0.0, 0.6};
    return std::none_of(lanes.begin(), lanes.end(), [&](double lane) {
      const Vector2d from = beat.a + lane * kPersonDiameter * perpendicular(along);
      return std::isfinite(walls_.range(from, along, most));
    });
  }

  World& world_;
  const WallClutterOptions& options_;
  Random random_;
  RayCaster walls_;
  std::vector<Segment> way_;
};

}  // namespace

std::optional<WallClutterOptions> wall_clutter_named(std::string_view kind, int pieces) {
  WallClutterOptions options;
  if (kind == "against") {
    options.against = pieces;
  } else if (kind == "piercing") {
    options.piercing = pieces;
  } else if (kind == "along") {
    options.along = pieces;
  } else if (kind == "rows") {
    options.rows = pieces;
  } else if (kind == "groups") {
    options.groups = pieces;
  } else if (kind == "mixed") {
    options.piercing = pieces / 4;
    options.along = pieces / 16;
    options.against = pieces - options.piercing - options.along;
  } else {
    return std::nullopt;
  }
  return options;
}

int add_wall_clutter(World& world, const WallClutterOptions& options, std::uint64_t seed) {
  if (world.path.empty()) return 0;
  Stacker stacker(world, options, seed);
  int placed = 0;
  for (int i = 0; i < options.against; ++i) placed += stacker.add_against();
  for (int i = 0; i < options.piercing; ++i) placed += stacker.add_piercing();
  for (int i = 0; i < options.along; ++i) placed += stacker.add_along();
  for (int i = 0; i < options.rows; ++i) placed += stacker.add_row();
  for (int i = 0; i < options.groups; ++i) placed += stacker.add_group();
  return placed;
}

}  // namespace adit
