#include "panel_scene.hpp"

#include <algorithm>
#include <cmath>

#include "adit/geometry/angle.hpp"
#include "adit/simulation/random.hpp"
#include "adit/simulation/world.hpp"

namespace adit {
namespace {

// Streams of the seed.
constexpr std::uint64_t kPlaces = 42;
constexpr std::uint64_t kDrives = 44;

constexpr double kDrift = 60.0;  // length of the entry (m)

/// The pillar that is missing, or beside the street at whose end the entry is: on no axis of
/// symmetry, and so near to the outline that both are in sight together. What surrounds one that is
/// missing far from there looks the same from four sides.
int marked_column(const PanelLayout& panel) { return panel.side / 3; }
constexpr int kMarkedRow = 1;

void add_box(double x0, double y0, double x1, double y1, std::vector<Segment>& plan) {
  const std::vector<Vector2d> corners{{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}};
  const std::vector<Segment> sides = outline(corners);
  plan.insert(plan.end(), sides.begin(), sides.end());
}

void add_outline_with_entry(const PanelLayout& panel, std::vector<Segment>& plan) {
  const double left = marked_column(panel) * panel.pitch_x_m;
  const double right = left + panel.street_m;
  const double width = panel.width_m();
  const double height = panel.height_m();
  const std::vector<Vector2d> corners{{left, 0.0},  {left, -kDrift}, {right, -kDrift}, {right, 0.0},
                                      {width, 0.0}, {width, height}, {0.0, height},    {0.0, 0.0}};
  const std::vector<Segment> sides = outline(corners);
  plan.insert(plan.end(), sides.begin(), sides.end());
}

/// A pose each half metre along the legs between the corners, its turns spread over some metres.
std::vector<Pose2> smooth_path(const std::vector<Vector2d>& corners) {
  constexpr double kStep = 0.5;
  constexpr double kCut = 2.0;   // a corner is passed at this distance (m)
  constexpr double kTurn = 0.2;  // rad a step
  const Vector2d first = corners[1] - corners[0];
  std::vector<Pose2> path{{corners[0].x(), corners[0].y(), std::atan2(first.y(), first.x())}};
  for (std::size_t next = 1; next < corners.size();) {
    const Pose2& at = path.back();
    const Vector2d to = corners[next] - at.translation();
    if (to.norm() < kCut) {
      ++next;
      continue;
    }
    const double turn = angle_between(at.theta, std::atan2(to.y(), to.x()));
    const double heading = wrap_angle(at.theta + std::clamp(turn, -kTurn, kTurn));
    const Vector2d there = at.translation() + kStep * unit_vector(heading);
    path.push_back({there.x(), there.y(), heading});
  }
  return path;
}

}  // namespace

std::vector<Segment> panel_walls(const PanelLayout& panel, std::uint64_t seed) {
  Random random(seed, kPlaces);
  std::vector<Segment> plan;
  if (panel.mark == PanelMark::entry) {
    add_outline_with_entry(panel, plan);
  } else {
    add_box(0.0, 0.0, panel.width_m(), panel.height_m(), plan);
  }
  const auto vary = [&] { return panel.variation_m * random.uniform(-1.0, 1.0); };
  for (int row = 0; row < panel.side; ++row) {
    for (int column = 0; column < panel.side; ++column) {
      const double x = column * panel.pitch_x_m + panel.street_m;
      const double y = row * panel.pitch_y_m + panel.street_m;
      const double left = x + vary();
      const double low = y + vary();
      const double right = x + panel.pitch_x_m - panel.street_m + vary();
      const double high = y + panel.pitch_y_m - panel.street_m + vary();
      const bool is_missing = panel.mark == PanelMark::missing_pillar &&
                              column == marked_column(panel) && row == kMarkedRow;
      if (!is_missing) add_box(left, low, right, high, plan);
    }
  }
  return plan;
}

std::vector<Pose2> places_in_panel(const PanelLayout& panel, int count, std::uint64_t seed) {
  constexpr double kClear = 1.5;
  Random random(seed, kPlaces + 1);
  std::vector<Pose2> places;
  while (static_cast<int>(places.size()) < count) {
    const int line = random.below(panel.side + 1);
    const double across = random.uniform(kClear, panel.street_m - kClear);
    const double along = random.uniform();
    const double heading = random.uniform(-kPi, kPi);
    const auto at = [&](double length) { return kClear + along * (length - 2.0 * kClear); };
    places.push_back(random.chance(0.5)
                         ? Pose2{line * panel.pitch_x_m + across, at(panel.height_m()), heading}
                         : Pose2{at(panel.width_m()), line * panel.pitch_y_m + across, heading});
  }
  return places;
}

std::vector<Pose2> drive_past_mark(const PanelLayout& panel, std::uint64_t seed) {
  Random random(seed, kDrives);
  const double aside = random.uniform(-1.0, 1.0);
  const auto street_x = [&](double column) {
    return column * panel.pitch_x_m + 0.5 * panel.street_m + aside;
  };
  const auto street_y = [&](double row) {
    return row * panel.pitch_y_m + 0.5 * panel.street_m + aside;
  };
  const double way = random.chance(0.5) ? 1.0 : -1.0;
  const double far = way * (3.0 + random.below(3));
  const double begin = random.uniform(-0.3, 0.3);
  const int column = marked_column(panel);
  if (panel.mark == PanelMark::entry) {
    const double row = 4.0 + random.below(3);
    return smooth_path({{street_x(column + far + begin), street_y(row)},
                        {street_x(column), street_y(row)},
                        {street_x(column), street_y(0.0)},
                        {street_x(column - way), street_y(0.0)}});
  }
  const double row = kMarkedRow + random.below(2);
  const double start = row + 2.0 + random.below(3) + begin;
  return smooth_path({{street_x(column + far), street_y(start)},
                      {street_x(column + far), street_y(row)},
                      {street_x(column - 2.0 * way), street_y(row)}});
}

}  // namespace adit
