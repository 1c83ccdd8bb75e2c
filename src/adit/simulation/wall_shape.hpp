#pragma once

#include <span>
#include <vector>

#include "adit/geometry/pose2.hpp"
#include "adit/simulation/random.hpp"

namespace adit {

/// How real walls differ from the straight lines of a plan.
struct RoughnessOptions {
  double rms_m = 0.15;
  double correlation_m = 1.5;
  double wave_rms_m = 0.0;
  double wave_correlation_m = 5.0;
  double rib_depth_m = 0.0;
  double rib_spacing_m = 3.0;
  double corner_radius_m = 0.7;
  double point_spacing_m = 0.25;

  template <class Self, class Field>
  static void visit(Self& self, Field&& field) {
    field("rms_m", self.rms_m, "roughness of the walls across the plan's line, one sigma (m)");
    field("correlation_m", self.correlation_m,
          "distance along the wall at which the roughness' correlation falls to 1/e (m)");
    field("wave_rms_m", self.wave_rms_m, "long waves of the walls, one sigma (m)");
    field("wave_correlation_m", self.wave_correlation_m,
          "distance at which the waves' correlation falls to 1/e (m)");
    field("rib_depth_m", self.rib_depth_m,
          "step where one blasting round ends and the next begins, a saw-tooth (m)");
    field("rib_spacing_m", self.rib_spacing_m, "length of a blasting round (m)");
    field("corner_radius_m", self.corner_radius_m, "radius of the corners (m)");
    field("point_spacing_m", self.point_spacing_m, "length of the true walls' segments (m)");
  }
};

/// A line through points, open or closed.
struct Polyline {
  std::vector<Vector2d> points;
  bool closed = false;
};

/// The same line with arcs for corners; a radius too large for its neighbours is made smaller.
Polyline round_corners(const Polyline& line, double radius, double spacing);

/// The same line with points about `spacing` apart; an open line keeps its ends.
Polyline resample(const Polyline& line, double spacing);

/// What stands in the mine where the plan shows this closed outline.
Polyline roughen(const Polyline& outline, const RoughnessOptions& options, Random& random);

/// A drive along the way points: corners rounded, poses `step` apart, headings along the way.
std::vector<Pose2> drive_through(std::span<const Vector2d> way_points, double radius, double step);

}  // namespace adit
