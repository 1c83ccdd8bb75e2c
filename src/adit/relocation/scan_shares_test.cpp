#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "adit/relocation/scan_likelihood.hpp"

namespace adit {
namespace {

std::vector<Segment> closed(const std::vector<Vector2d>& corners) {
  std::vector<Segment> walls;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    walls.push_back({corners[i], corners[(i + 1) % corners.size()]});
  }
  return walls;
}

/// A square room of 20 m, its middle the origin.
LineMap room() {
  const std::vector<Vector2d> corners{{-10.0, -10.0}, {10.0, -10.0}, {10.0, 10.0}, {-10.0, 10.0}};
  return LineMap::build(closed(corners));
}

/// What a scanner in the middle of the room sees, a beam a degree.
LaserScan scan_of_room() {
  LaserScan scan;
  scan.first_bearing = -kPi;
  scan.bearing_step = radians(1.0);
  scan.max_range = 50.0;
  for (int i = 0; i < 360; ++i) {
    const Vector2d beam = unit_vector(scan.bearing(static_cast<std::size_t>(i)));
    scan.ranges.push_back(10.0 / beam.cwiseAbs().maxCoeff());
  }
  return scan;
}

BeamShares shares_of(const LaserScan& scan) {
  ScannerModel scanner;
  scanner.range_sigma_m = 0.02;
  scanner.max_range_m = 50.0;
  LikelihoodOptions options;
  options.beams = 360;
  ScanLikelihood likelihood;
  likelihood.set_scan(scan, scanner, {0.05, 1.5, 0.0}, options);
  return likelihood.shares_at(room(), {}, 0.02);
}

TEST(BeamShares, AllOfAnUndisturbedScanIsOnTheWalls) {
  const BeamShares shares = shares_of(scan_of_room());
  EXPECT_EQ(shares.on_wall, 1.0);
  EXPECT_EQ(shares.returns, 360.0);
  EXPECT_EQ(shares.missing, 0.0);
}

TEST(BeamShares, CountWhatStandsBeforeAndWhatIsSeenThroughAWall) {
  LaserScan scan = scan_of_room();
  for (std::size_t i = 0; i < 36; ++i) scan.ranges[i] = 3.0;
  for (std::size_t i = 36; i < 54; ++i) scan.ranges[i] += 5.0;
  const BeamShares shares = shares_of(scan);
  EXPECT_NEAR(shares.before, 0.10, 1e-9);
  EXPECT_NEAR(shares.through, 0.05, 1e-9);
  EXPECT_NEAR(shares.on_wall, 0.85, 1e-9);
}

TEST(BeamShares, CountBeamsThatShouldHaveMetAWall) {
  LaserScan scan = scan_of_room();
  for (std::size_t i = 0; i < 36; ++i) scan.ranges[i] = scan.max_range;
  const BeamShares shares = shares_of(scan);
  EXPECT_NEAR(shares.missing, 0.10, 1e-9);
  EXPECT_NEAR(shares.on_wall, 1.0, 1e-9);
}

}  // namespace
}  // namespace adit
