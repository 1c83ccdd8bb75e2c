#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "adit/geometry/segment.hpp"
#include "adit/simulation/ramp.hpp"
#include "adit/simulation/timed_path.hpp"

namespace adit {

/// Somebody who paces between two points; a round body.
struct Person {
  Vector2d from = Vector2d::Zero();
  Vector2d to = Vector2d::Zero();
  double speed = 0.0;      ///< m/s; 0 stands still at `from`
  double diameter = 0.45;  ///< m
};

/// A rigid body that drives, such as another machine: there from the first knot of its way to the
/// last, else nowhere.
struct Mover {
  std::vector<Vector2d> body;  ///< its corners in its own frame, x ahead (m)
  TimedPath way;               ///< map_from_body
};

/// A place to drive in: the truth, and what the map says of it. Metres, map frame.
struct World {
  std::vector<Segment> plan;     ///< what the map says
  std::vector<Segment> walls;    ///< what the scanner meets of it
  std::vector<Segment> clutter;  ///< things that stand about and are in no plan
  std::vector<Person> people;    ///< people who move about
  std::vector<Mover> movers;     ///< machines that drive about
  std::vector<Ramp> ramps;       ///< floors that are not level
  std::vector<Pose2> path;       ///< a drive along the middle of the openings; may be empty
};

/// Everything that does not move: walls, then clutter.
std::vector<Segment> fixed_segments(const World& world);

/// Outlines of the people at a time (s), eight sides each.
std::vector<Segment> people_at(const World& world, double stamp);

/// Outlines of the movers that are there at a time (s).
std::vector<Segment> movers_at(const World& world, double stamp);

/// All that a vehicle meets at this time and nowhere to stay: people, movers, and the lines where
/// ramps cut its scanner's plane.
std::vector<Segment> passing_segments(const World& world, const StampedPose& map_from_vehicle);

/// The closed outline through the points.
std::vector<Segment> outline(std::span<const Vector2d> points);

/// A world whose walls are exactly the plan's. The path is left to the caller.
World from_plan(std::vector<Segment> segments);

/// How far the walls stand from the plan: RMS distance of their midpoints from it (m), what a
/// surveyor would state. 0 where plan and walls are the same segments, or one of them is empty.
double plan_error(const World& world);

/// The corridor mockup of the paper's section IV-D: 29 segments, 6 m corridors around one pillar,
/// about 20 x 30 m, four 0.4 m columns on the left concrete wall; its path is `mockup_path`.
///
/// The paper prints no coordinates of the walls. These follow from its text, and from Table I,
/// whose positions lie in the middle of the corridors.
World mockup();

/// The 16 poses of the paper's run: positions surveyed (Table I), headings of the gyro (Table II).
///
/// The gyro's headings are sums of differences, so that the first row has none; the estimator's
/// 4.297 degrees stands in for it. That the machine then turned by 183 degrees before it drove off
/// is no slip: it steers all wheels and turns on the spot, and an estimate half a turn wrong would
/// not have been 0.4 m from the survey.
std::vector<Pose2> mockup_path();

}  // namespace adit
