#include "adit/simulation/mine_worlds.hpp"

#include <algorithm>
#include <cmath>

namespace adit {
namespace {

// Streams of the seed.
constexpr std::uint64_t kLayout = 1;
constexpr std::uint64_t kWalls = 2;

/// Adds a closed outline to the plan and, roughened, to the walls.
void add_outline(const std::vector<Vector2d>& corners, const RoughnessOptions& options,
                 Random& random, World& world) {
  const std::vector<Segment> ideal = outline(corners);
  world.plan.insert(world.plan.end(), ideal.begin(), ideal.end());
  const std::vector<Segment> real = outline(roughen({corners, true}, options, random).points);
  world.walls.insert(world.walls.end(), real.begin(), real.end());
}

/// Up and down through the crosscuts: along one entry, back along the next.
std::vector<Vector2d> panel_way_points(const PanelOptions& o, const Vector2d& size) {
  std::vector<Vector2d> points;
  const double half = 0.5 * o.entry_width_m;
  // The outermost crosscuts stay open in every row, whatever the shift.
  const double left = half;
  const double right = size.x() - half;
  for (int row = 0; row <= o.rows; ++row) {
    const double y = half + row * (o.entry_width_m + o.pillar_width_m);
    const bool forward = row % 2 == 0;
    points.emplace_back(forward ? left : right, y);
    points.emplace_back(forward ? right : left, y);
  }
  return points;
}

/// One leg's middle line.
struct Leg {
  Vector2d begin;
  Vector2d end;
  int side_cut = 0;  // +1 left, -1 right, 0 none

  Vector2d along() const { return (end - begin).normalized(); }
  double length() const { return (end - begin).norm(); }
};

std::vector<Leg> lay_legs(const DriftOptions& o, Random& random) {
  std::vector<Leg> legs;
  Vector2d at = Vector2d::Zero();
  double heading = 0.0;
  for (int i = 0; i < std::max(1, o.legs); ++i) {
    const Vector2d end = at + random.uniform(o.leg_min_m, o.leg_max_m) * unit_vector(heading);
    const int side = random.chance(0.5) ? 1 : -1;
    legs.push_back({at, end, random.chance(0.75) ? side : 0});
    at = end;
    const double bend = random.uniform(0.3, 1.0) * o.bend_max_rad;
    // Headings stay within a right angle of +x in all, so that the drift never meets itself.
    const bool left = std::abs(heading) < 0.5 ? random.chance(0.5) : heading < 0.0;
    heading += left ? bend : -bend;
  }
  return legs;
}

/// Where the walls of two legs meet on one side (+1 left, -1 right).
Vector2d mitre(const Leg& before, const Leg& after, double half_width, int side) {
  const Vector2d normals = perpendicular(before.along()) + perpendicular(after.along());
  return before.end + side * half_width * 2.0 / normals.squaredNorm() * normals;
}

/// The wall on one side from the drift's begin to its end.
std::vector<Vector2d> drift_side(const std::vector<Leg>& legs, const DriftOptions& o, int side) {
  const double half = 0.5 * o.width_m;
  std::vector<Vector2d> points;
  for (std::size_t i = 0; i < legs.size(); ++i) {
    const Vector2d along = legs[i].along();
    const Vector2d outward = side * perpendicular(along);
    if (i == 0) points.emplace_back(legs[i].begin + half * outward);
    if (legs[i].side_cut == side) {
      const Vector2d middle = 0.5 * (legs[i].begin + legs[i].end) + half * outward;
      const Vector2d sideways = 0.5 * o.side_cut_width_m * along;
      const Vector2d inward = o.side_cut_depth_m * outward;
      points.emplace_back(middle - sideways);
      points.emplace_back(middle - sideways + inward);
      points.emplace_back(middle + sideways + inward);
      points.emplace_back(middle + sideways);
    }
    points.emplace_back(i + 1 < legs.size() ? mitre(legs[i], legs[i + 1], half, side)
                                            : Vector2d(legs[i].end + half * outward));
  }
  return points;
}

}  // namespace

World panel(const PanelOptions& options, std::uint64_t seed) {
  Random layout(seed, kLayout);
  Random walls(seed, kWalls);
  const double entry = options.entry_width_m;
  const double pitch_x = options.pillar_length_m + entry;
  const double pitch_y = options.pillar_width_m + entry;
  const Vector2d size(options.columns * pitch_x + entry + std::abs(options.offset_m),
                      options.rows * pitch_y + entry);
  World world;
  add_outline({{0.0, 0.0}, {size.x(), 0.0}, size, {0.0, size.y()}}, options.walls, walls, world);
  for (int row = 0; row < options.rows; ++row) {
    for (int column = 0; column < options.columns; ++column) {
      const double shift =
          (row % 2 == 1) == (options.offset_m > 0.0) ? std::abs(options.offset_m) : 0.0;
      const auto vary = [&] { return layout.uniform(-1.0, 1.0) * options.variation_m; };
      const double x0 = entry + column * pitch_x + shift + vary();
      const double x1 = entry + column * pitch_x + shift + options.pillar_length_m + vary();
      const double y0 = entry + row * pitch_y + vary();
      const double y1 = entry + row * pitch_y + options.pillar_width_m + vary();
      // Clockwise, like the outer outline seen from inside: rock on the same hand.
      add_outline({{x0, y0}, {x0, y1}, {x1, y1}, {x1, y0}}, options.walls, walls, world);
    }
  }
  world.path = drive_through(panel_way_points(options, size), 0.5 * entry, options.path_step_m);
  return world;
}

World drift(const DriftOptions& options, std::uint64_t seed) {
  Random layout(seed, kLayout);
  Random walls(seed, kWalls);
  const std::vector<Leg> legs = lay_legs(options, layout);
  std::vector<Vector2d> corners = drift_side(legs, options, -1);
  const std::vector<Vector2d> left = drift_side(legs, options, 1);
  corners.insert(corners.end(), left.rbegin(), left.rend());
  World world;
  add_outline(corners, options.walls, walls, world);

  std::vector<Vector2d> way{legs.front().begin + options.width_m * legs.front().along()};
  for (std::size_t i = 0; i + 1 < legs.size(); ++i) way.push_back(legs[i].end);
  way.emplace_back(legs.back().end - options.width_m * legs.back().along());
  world.path = drive_through(way, 2.0 * options.width_m, options.path_step_m);
  return world;
}

}  // namespace adit
