#pragma once

#include <algorithm>
#include <vector>

#include "adit/motion/odometry.hpp"
#include "adit/scan/laser_scan.hpp"
#include "adit/scan/scanner_model.hpp"
#include "adit/simulation/random.hpp"
#include "support/casting.hpp"

namespace adit::testing {

inline void add_outline(std::vector<Segment>& walls, const std::vector<Vector2d>& corners) {
  for (std::size_t i = 0; i < corners.size(); ++i) {
    walls.push_back({corners[i], corners[(i + 1) % corners.size()]});
  }
}

/// The paper's mockup: corridors of 6 m around a pillar, columns on the left wall, one leg aslant.
inline std::vector<Segment> mockup_walls() {
  std::vector<Vector2d> hall{{0.5, 30.0}};
  for (const double y : {22.5, 16.5, 10.5, 4.5}) {
    for (const Vector2d& corner :
         {Vector2d(0.5, y + 0.4), Vector2d(0.9, y + 0.4), Vector2d(0.9, y), Vector2d(0.5, y)}) {
      hall.push_back(corner);
    }
  }
  for (const Vector2d& corner :
       {Vector2d(0.5, 0.3), Vector2d(18.0, 0.3), Vector2d(20.0, 2.3), Vector2d(20.0, 23.7),
        Vector2d(6.5, 18.73), Vector2d(6.5, 24.0), Vector2d(7.0, 24.0), Vector2d(7.0, 30.0)}) {
    hall.push_back(corner);
  }
  std::vector<Segment> walls;
  add_outline(walls, hall);
  add_outline(walls, {{6.5, 6.3}, {6.5, 12.33}, {14.0, 15.1}, {14.0, 6.3}});
  return walls;
}

inline bool is_open(const std::vector<Segment>& walls, const Vector2d& place) {
  int crossings = 0;
  for (const Segment& wall : walls) {
    if (distance(wall, place) < 1.0) return false;
    crossings += cast_at(wall, place, unit_vector(1.234)) < kInfinity ? 1 : 0;
  }
  return crossings % 2 == 1;
}

inline Pose2 random_pose(const std::vector<Segment>& walls, Random& random) {
  for (;;) {
    const double y = random.uniform(0.3, 30.0);
    const double x = random.uniform(0.5, 20.0);
    if (is_open(walls, {x, y})) return {x, y, random.uniform(-kPi, kPi)};
  }
}

/// What a scanner meets, and what goes wrong.
struct Scene {
  std::vector<Segment> solid = mockup_walls();
  double range_sigma_m = 0.02;
  double dust_ratio = 0.0;
  double dropout_ratio = 0.0;
};

inline ScannerModel scanner(double range_sigma_m = 0.02) {
  ScannerModel model;
  model.range_sigma_m = range_sigma_m;
  model.quantisation_m = 0.0;
  model.max_range_m = 50.0;
  return model;
}

inline LaserScan scan_from(const Pose2& vehicle, const Scene& scene, Random& random) {
  constexpr int kBeams = 360;
  LaserScan scan;
  scan.first_bearing = -kPi;
  scan.bearing_step = kTwoPi / kBeams;
  scan.max_range = 50.0;
  scan.vehicle_from_laser = {0.5, -0.2, radians(20.0)};
  const Pose2 laser = vehicle * scan.vehicle_from_laser;
  for (int i = 0; i < kBeams; ++i) {
    const Vector2d direction = unit_vector(laser.theta + scan.first_bearing + i * kTwoPi / kBeams);
    double range = kInfinity;
    for (const Segment& wall : scene.solid) {
      range = std::min(range, cast_at(wall, laser.translation(), direction));
    }
    if (random.chance(scene.dust_ratio)) range = std::min(range, random.uniform(0.1, 5.0));
    range += scene.range_sigma_m * random.normal();
    scan.ranges.push_back(random.chance(scene.dropout_ratio) ? 50.0 : std::min(range, 50.0));
  }
  return scan;
}

/// What is known before: so wrong, one sigma.
inline PoseWithCovariance around(const Pose2& pose, double metres, double radians) {
  return {pose, Vector3d(metres, metres, radians).cwiseAbs2().asDiagonal()};
}

inline Pose2 moved_by(const Pose2& pose, double x, double y, double theta) {
  return Pose2::from_vector(pose.vector() + Vector3d(x, y, theta));
}

}  // namespace adit::testing
