#include "grounds.hpp"

#include <fmt/core.h>

#include "../panel_scene.hpp"
#include "adit/io/plan.hpp"
#include "adit/io/trajectory.hpp"
#include "adit/simulation/mine_worlds.hpp"
#include "adit/simulation/random.hpp"
#include "adit/simulation/wall_shape.hpp"

namespace adit {
namespace {

// Streams of the seed.
constexpr std::uint64_t kWalls = 61;
constexpr std::uint64_t kCuts = 62;

constexpr std::uint64_t kSeed = 20261130;  // of worlds that are drawn
constexpr std::int64_t kVariants = 8;

constexpr double kLength = 300.0;  // of a drift whose ends are out of reach (m)
constexpr double kWidth = 5.0;

Result<Ground> real_mine(const std::string& name, const std::string& data) {
  const auto plan = read_plan(fmt::format("{}/mines/{}.csv", data, name));
  if (!plan) return tl::unexpected(plan.error());
  const auto poses = read_trajectory(fmt::format("{}/mines/{}_poses.tum", data, name));
  if (!poses) return tl::unexpected(poses.error());
  Ground ground;
  ground.world = from_plan(plan->segments);
  for (const StampedPose& pose : *poses) ground.places.push_back(pose.pose);
  return ground;
}

/// A drive of 90 m along the middle, of which the ends are out of sight.
std::vector<Pose2> along_drift(double from) {
  constexpr double kWay = 90.0;
  constexpr double kStep = 0.5;
  const std::vector<Vector2d> way{{from, 0.5 * kWidth}, {from + kWay, 0.5 * kWidth}};
  return drive_through(way, 0.0, kStep);
}

World straight_drift(std::uint64_t seed) {
  Random random(seed, kWalls);
  const std::vector<Vector2d> corners{{0.0, 0.0}, {kLength, 0.0}, {kLength, kWidth}, {0.0, kWidth}};
  World world;
  world.plan = outline(corners);
  world.walls = outline(roughen({corners, true}, RoughnessOptions{}, random).points);
  world.path = along_drift(105.0);
  return world;
}

/// Bare for the first 150 m, then with crosscuts to both sides 8 to 20 m apart.
World drift_with_crosscuts(std::uint64_t seed) {
  constexpr double kBare = 150.0;
  constexpr double kCutWidth = 4.0;
  constexpr double kDepth = 12.0;
  Random random(seed, kCuts);
  const auto side = [&](double y, double depth) {
    std::vector<Vector2d> points{{0.0, y}};
    double x = kBare + random.uniform(0.0, 10.0);
    for (; x + kCutWidth < kLength - 10.0; x += kCutWidth + random.uniform(8.0, 20.0)) {
      points.insert(points.end(),
                    {{x, y}, {x, y + depth}, {x + kCutWidth, y + depth}, {x + kCutWidth, y}});
    }
    points.emplace_back(kLength, y);
    return points;
  };
  std::vector<Vector2d> corners = side(0.0, -kDepth);
  const std::vector<Vector2d> upper = side(kWidth, kDepth);
  corners.insert(corners.end(), upper.rbegin(), upper.rend());
  World world = from_plan(outline(corners));
  world.path = along_drift(100.0);
  return world;
}

Ground marked_panel(PanelMark mark, std::int64_t variant) {
  constexpr int kPlaces = 40;
  PanelLayout layout;
  layout.mark = mark;
  if (mark == PanelMark::entry) layout.pitch_y_m = 25.0;
  const std::uint64_t seed = kSeed + static_cast<std::uint64_t>(variant);
  Ground ground;
  ground.world = from_plan(panel_walls(layout, seed));
  ground.places = places_in_panel(layout, kPlaces, seed);
  if (mark == PanelMark::none) return ground;
  PanelLayout bare = layout;
  bare.mark = PanelMark::none;
  ground.bare = panel_walls(bare, seed);
  for (std::uint64_t i = 0; i < kPlaces; ++i) {
    ground.drives.push_back(drive_past_mark(layout, seed * 1000003u + i));
  }
  return ground;
}

/// The mines of which there are several.
bool has_variants(Mine mine) {
  return mine == Mine::panel || mine == Mine::crosscuts || mine == Mine::straight;
}

/// Mines through which the machine drives where it likes; in the others it has a path.
bool is_roamed(Mine mine) {
  return mine == Mine::niosh || mine == Mine::edgar || mine == Mine::panel ||
         mine == Mine::regular_panel || mine == Mine::gap_panel || mine == Mine::entry_panel;
}

/// Keeps clear of where rough walls stand as well.
DriveMap ways_of(const Ground& ground) {
  constexpr std::size_t kPlaces = 200;
  std::vector<Vector2d> inside;
  for (const Pose2& place : ground.places) {
    if (inside.size() < kPlaces) inside.push_back(place.translation());
  }
  DriveMapOptions options;
  options.clearance_m = 1.0;
  return DriveMap(ground.world.walls, options, inside);
}

/// Places all over the openings, of a world that has a path through them.
Ground with_places(World world) {
  Ground ground;
  ground.places = world.path;
  ground.world = std::move(world);
  const DriveMap ways = ways_of(ground);
  ground.places.clear();
  for (std::size_t i = 0; i < ways.size(); ++i) {
    ground.places.push_back({ways.place(i).x(), ways.place(i).y(), 0.0});
  }
  return ground;
}

}  // namespace

Result<Ground> make_ground(Mine mine, std::int64_t variant, const std::string& data) {
  const std::uint64_t seed = kSeed + static_cast<std::uint64_t>(variant);
  switch (mine) {
    case Mine::niosh:
      return real_mine("niosh", data);
    case Mine::edgar:
      return real_mine("edgar", data);
    case Mine::panel:
      return with_places(panel({}, seed));
    case Mine::mockup:
      return with_places(mockup());
    case Mine::crosscuts:
      return with_places(drift_with_crosscuts(seed));
    case Mine::straight:
      return with_places(straight_drift(seed));
    case Mine::regular_panel:
      return marked_panel(PanelMark::none, variant);
    case Mine::gap_panel:
      return marked_panel(PanelMark::missing_pillar, variant);
    case Mine::entry_panel:
      return marked_panel(PanelMark::entry, variant);
  }
  return fail("no such mine");
}

Result<std::shared_ptr<const Ground>> Grounds::of(Mine mine, std::int64_t drive) {
  const std::int64_t variant = has_variants(mine) ? drive % kVariants : 0;
  Slot* slot = nullptr;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    slot = &slots_[{mine, variant}];
  }
  const std::lock_guard<std::mutex> lock(slot->making);
  if (slot->ground) return slot->ground;
  auto made = make_ground(mine, variant, data_);
  if (!made) return tl::unexpected(made.error());
  made->caster = RayCaster(made->world.walls);
  if (is_roamed(mine)) made->ways = ways_of(*made);
  made->map = LineMap::build(made->world.plan);
  made->index = std::make_shared<const PlaceIndex>(PlaceIndex::build(made->map, {}, threads_));
  slot->ground = std::make_shared<const Ground>(std::move(*made));
  return slot->ground;
}

}  // namespace adit
