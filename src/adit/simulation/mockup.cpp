#include <cmath>

#include "adit/simulation/paper_run.hpp"
#include "adit/simulation/world.hpp"

namespace adit {
namespace {

constexpr double kCorridor = 6.0;  // m, the caption of Fig. 8
constexpr double kColumn = 0.4;    // m, section IV-D
constexpr double kLeft = 0.5;      // x of the left concrete wall
constexpr double kBottom = 0.3;    // y of the lower one
constexpr double kRight = 20.0;    // x of the partition at the far right
constexpr double kTop = 30.0;      // y of the partition at the far end

// The middle of the slanting corridor: a straight line through the last four surveyed positions.
constexpr double kSlantX = 5.763;
constexpr double kSlantY = 15.258;
constexpr double kSlantRise = 0.3686;

/// y of the slanting corridor's wall at x, on the side of +1 (upper) or -1 (lower).
double slanting_wall(double x, double side) {
  const double half_width_upright = 0.5 * kCorridor * std::sqrt(1.0 + kSlantRise * kSlantRise);
  return kSlantY + kSlantRise * (x - kSlantX) + side * half_width_upright;
}

/// The left wall from the top down, with its columns.
std::vector<Vector2d> left_wall() {
  std::vector<Vector2d> points{{kLeft, kTop}};
  for (const double y : {22.5, 16.5, 10.5, 4.5}) {
    points.emplace_back(kLeft, y + kColumn);
    points.emplace_back(kLeft + kColumn, y + kColumn);
    points.emplace_back(kLeft + kColumn, y);
    points.emplace_back(kLeft, y);
  }
  points.emplace_back(kLeft, kBottom);
  return points;
}

}  // namespace

World mockup() {
  const double near_x = kLeft + kCorridor;  // the partition opposite the left wall
  const double far_x = kRight - kCorridor;  // the pillar's right side
  const double panel_y = 24.0;              // two panels that are not flush
  const double panel_x = near_x + 0.5;
  const double mitre = 2.0;  // a panel across the lower right corner

  std::vector<Vector2d> hall = left_wall();
  hall.emplace_back(kRight - mitre, kBottom);
  hall.emplace_back(kRight, kBottom + mitre);
  hall.emplace_back(kRight, slanting_wall(kRight, 1.0));
  hall.emplace_back(near_x, slanting_wall(near_x, 1.0));
  hall.emplace_back(near_x, panel_y);
  hall.emplace_back(panel_x, panel_y);
  hall.emplace_back(panel_x, kTop);
  const std::vector<Vector2d> pillar{{near_x, kBottom + kCorridor},
                                     {near_x, slanting_wall(near_x, -1.0)},
                                     {far_x, slanting_wall(far_x, -1.0)},
                                     {far_x, kBottom + kCorridor}};

  std::vector<Segment> segments = outline(hall);
  const std::vector<Segment> inner = outline(pillar);
  segments.insert(segments.end(), inner.begin(), inner.end());
  World world = from_plan(std::move(segments));
  world.path = mockup_path();
  return world;
}

std::vector<Pose2> mockup_path() {
  std::vector<Pose2> path;
  for (const PaperRow& row : kPaperRun) {
    const double heading = row.gyro_deg.value_or(row.estimated_deg);
    path.push_back({row.surveyed_x, row.surveyed_y, wrap_angle(radians(heading))});
  }
  return path;
}

}  // namespace adit
