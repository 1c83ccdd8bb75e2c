// A scan taken on the move, deskewed, against the walls and against the scan of a machine at rest.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "adit/deskew/deskewer.hpp"
#include "adit/extraction/extraction.hpp"
#include "adit/geometry/segment.hpp"
#include "adit/simulation/scanner.hpp"
#include "adit/simulation/world.hpp"

namespace adit {
namespace {

constexpr double kStamp = 3.0;
const Twist2 kDrive{5.0, 0.0, radians(45.0)};
const Pose2 kMounting{1.5, -0.4, radians(10.0)};

ScannerSpec moving(ScannerSpec spec, SweepMoment stamp) {
  spec.model.sweep_s = 0.2;
  spec.model.stamp = stamp;
  spec.vehicle_from_laser = kMounting;
  return spec;
}

ScannerSpec perfect(ScannerSpec spec) {
  spec.model.range_sigma_m = 0.0;
  spec.model.quantisation_m = 0.0;
  return spec;
}

/// Along the circle, in pieces so short that their straightness does not show.
TimedPath circle_through(const Pose2& map_from_vehicle, const Twist2& drive) {
  TimedPath path;
  for (int i = -250; i <= 250; ++i) {
    const double seconds = 1e-3 * i;
    path.knots.push_back({kStamp + seconds, map_from_vehicle * moved(drive, seconds)});
  }
  return path;
}

double distance_from(const std::vector<Segment>& walls, const Vector2d& point) {
  double nearest = std::numeric_limits<double>::infinity();
  for (const Segment& wall : walls) nearest = std::min(nearest, distance(wall, point));
  return nearest;
}

double worst_distance(const LaserScan& scan, const Pose2& map_from_vehicle,
                      const std::vector<Segment>& walls) {
  const Pose2 map_from_laser = map_from_vehicle * scan.vehicle_from_laser;
  double worst = 0.0;
  for (std::size_t i = 0; i < scan.ranges.size(); ++i) {
    if (!scan.has_return(i)) continue;
    const Vector2d point = map_from_laser * (scan.ranges[i] * unit_vector(scan.bearing(i)));
    worst = std::max(worst, distance_from(walls, point));
  }
  return worst;
}

std::size_t returns(const LaserScan& scan) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < scan.ranges.size(); ++i) count += scan.has_return(i) ? 1 : 0;
  return count;
}

LaserScan deskewed(const LaserScan& scan, const ScannerSpec& spec, const Twist2& drive) {
  Deskewer deskewer;
  LaserScan out;
  deskewer.deskew(scan, spec.model, drive, {}, out);
  return out;
}

class MovingScan : public testing::TestWithParam<SweepMoment> {};

TEST_P(MovingScan, LiesOnTheWallsAgain) {
  const World world = mockup();
  const RayCaster walls(world.walls);
  Random random(1);
  for (const ScannerSpec& scanner : {cyclone(), sick()}) {
    const ScannerSpec spec = perfect(moving(scanner, GetParam()));
    for (const Pose2& pose : mockup_path()) {
      const LaserScan raw =
          simulate_sweep(walls, circle_through(pose, kDrive), kStamp, spec, random);
      const LaserScan out = deskewed(raw, spec, kDrive);
      EXPECT_GT(worst_distance(raw, pose, world.walls), 0.1);
      EXPECT_LT(worst_distance(out, pose, world.walls), 1e-3);
      EXPECT_GT(returns(out), 0.85 * static_cast<double>(returns(raw)));
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Stamps, MovingScan,
                         testing::Values(SweepMoment::start, SweepMoment::middle,
                                         SweepMoment::end));

/// How many corners of both arms there are, and how many of them the other list has as well.
struct Agreement {
  int corners = 0;
  int found = 0;
};

Agreement agreement(const FeatureList& of, const FeatureList& in, double metres, double radians) {
  Agreement result;
  for (const Corner& corner : of.corners) {
    if (!corner.concave_angle) continue;
    ++result.corners;
    const bool is_there =
        std::any_of(in.corners.begin(), in.corners.end(), [&](const Corner& other) {
          return other.concave_angle && (other.position - corner.position).norm() < metres &&
                 std::abs(*other.concave_angle - *corner.concave_angle) < radians &&
                 std::abs(angle_between(*other.bisector, *corner.bisector)) < radians;
        });
    result.found += is_there ? 1 : 0;
  }
  return result;
}

/// Corners of scans at rest that are found again in scans taken otherwise.
struct Comparison {
  Agreement again;     ///< a second scan at rest
  Agreement deskewed;  ///< on the move, deskewed
  Agreement raw;       ///< on the move, taken for one at rest
  int lines_at_rest = 0;
  int lines_deskewed = 0;
};

void add(Agreement& sum, const Agreement& one) {
  sum.corners += one.corners;
  sum.found += one.found;
}

Comparison compare_features(const ScannerSpec& spec, double metres, double radians) {
  const RayCaster walls(mockup().walls);
  Random random(7);
  Extractor at_rest;
  Extractor other;
  Comparison all;
  for (const Pose2& pose : mockup_path()) {
    const FeatureList& expected =
        at_rest.extract(simulate_scan(walls, pose, spec, random), spec.model, {});
    const auto compare = [&](const LaserScan& scan) {
      return agreement(expected, other.extract(scan, spec.model, {}), metres, radians);
    };
    const LaserScan raw = simulate_sweep(walls, circle_through(pose, kDrive), kStamp, spec, random);
    add(all.again, compare(simulate_scan(walls, pose, spec, random)));
    add(all.raw, compare(raw));
    add(all.deskewed, compare(deskewed(raw, spec, kDrive)));
    all.lines_at_rest += static_cast<int>(expected.lines.size());
    all.lines_deskewed += static_cast<int>(other.features().lines.size());
  }
  return all;
}

TEST(MovingScan, ShowsTheFeaturesOfAScanAtRest) {
  const Comparison fine = compare_features(moving(sick(), SweepMoment::middle), 0.05, radians(3.0));
  const Comparison coarse =
      compare_features(moving(cyclone(), SweepMoment::middle), 0.3, radians(10.0));
  for (const Comparison& scans : {fine, coarse}) {
    EXPECT_GT(scans.again.found, 60);
    EXPECT_GT(scans.deskewed.found, 0.9 * scans.again.found);
    EXPECT_LT(scans.raw.found, 0.5 * scans.again.found);
    EXPECT_NEAR(scans.lines_deskewed, scans.lines_at_rest, 0.05 * scans.lines_at_rest);
  }
}

}  // namespace
}  // namespace adit
