// Which wall a beam is compared with, and what becomes of beams without one; numbers worked out by
// hand.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "adit/refinement/beam_residuals.hpp"
#include "support/casting.hpp"

namespace adit {
namespace {

using testing::kInfinity;
using testing::map_of;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

/// Beams at every 10 degrees from the origin, all with this range.
LaserScan star(double range) {
  LaserScan scan;
  scan.first_bearing = 0.0;
  scan.bearing_step = radians(10.0);
  scan.max_range = 20.0;
  scan.ranges.assign(36, range);
  return scan;
}

ScannerModel fine_scanner() {
  ScannerModel scanner;
  scanner.range_sigma_m = 0.01;
  scanner.quantisation_m = 0.0;
  scanner.max_range_m = 30.0;
  scanner.min_range_m = 0.5;
  return scanner;
}

std::vector<BeamResidual> beams_of(const LaserScan& scan, const LineMap& map,
                                   const RefinementOptions& options = {}) {
  BeamResiduals residuals;
  residuals.set_scan(scan, fine_scanner());
  residuals.compute(map, {}, {}, {}, options);
  const std::span<const BeamResidual> beams = residuals.beams();
  return {beams.begin(), beams.end()};
}

TEST(BeamResiduals, ABeamWithoutReturnIsThereAndSaysNothing) {
  const LineMap map = map_of({{Vector2d(5.0, -20.0), Vector2d(5.0, 20.0)}});
  for (const double none : {20.0, 25.0, kInfinity, kNan, 0.0, -1.0, 0.4}) {
    LaserScan scan = star(5.2);
    scan.ranges[1] = none;
    const std::vector<BeamResidual> beams = beams_of(scan, map);
    ASSERT_GT(beams.size(), 2u);
    EXPECT_TRUE(beams[0].has_return);
    EXPECT_NEAR(beams[0].residual, 0.2, 1e-9);
    EXPECT_EQ(beams[1].beam, 1);
    EXPECT_FALSE(beams[1].has_return) << none;
    EXPECT_EQ(beams[1].residual, 0.0);
    EXPECT_NEAR(beams[1].range, 5.0 / std::cos(radians(10.0)), 1e-9);
  }
}

TEST(BeamResiduals, BeamsOnAMissingWallCountAsWithoutReturn) {
  // The second stands close behind the first's lower half: a neighbour that a beam may have met.
  const LineMap map = map_of({{Vector2d(5.0, -20.0), Vector2d(5.0, 20.0)},
                              {Vector2d(-4.0, -20.0), Vector2d(-4.0, 20.0)},
                              {Vector2d(5.2, -20.0), Vector2d(5.2, 0.0)}});
  const LaserScan scan = star(5.0);
  const int ahead = beams_of(scan, map).front().wall;
  BeamResiduals residuals;
  residuals.set_scan(scan, fine_scanner(), ahead);
  residuals.compute(map, {}, {}, {}, {});
  int missing = 0;
  int others = 0;
  for (const BeamResidual& beam : residuals.beams()) {
    EXPECT_EQ(beam.has_return, beam.wall != ahead) << beam.beam;
    (beam.has_return ? others : missing) += 1;
    if (beam.has_return) continue;
    EXPECT_EQ(beam.residual, 0.0);
    EXPECT_EQ(beam.measured, beam.range);
  }
  EXPECT_GT(missing, 5);
  EXPECT_GT(others, 5);
  residuals.set_scan(scan, fine_scanner());  // and not the next scan's
  residuals.compute(map, {}, {}, {}, {});
  for (const BeamResidual& beam : residuals.beams()) EXPECT_TRUE(beam.has_return);
}

TEST(BeamResiduals, ReturnsWhereTheMapHasNothingAreCounted) {
  const LineMap map = map_of({{Vector2d(5.0, -6.0), Vector2d(5.0, 6.0)}});
  LaserScan scan = star(7.0);
  scan.ranges[18] = 20.0;  // the beam that looks back
  BeamResiduals residuals;
  residuals.set_scan(scan, fine_scanner());
  residuals.compute(map, {}, {}, {}, {});
  EXPECT_EQ(residuals.beams().size(), 11u);  // up to 50 degrees on either side
  EXPECT_EQ(residuals.unmapped(), 24);
  residuals.compute(map, {}, {}, {}, {});
  EXPECT_EQ(residuals.unmapped(), 24);
}

TEST(BeamResiduals, AnotherMapInTheSamePlaceIsSweptAnew) {
  LineMap map = map_of({{Vector2d(5.0, -30.0), Vector2d(5.0, 30.0)}});
  const LaserScan scan = star(5.0);
  BeamResiduals residuals;
  residuals.set_scan(scan, fine_scanner());
  residuals.compute(map, {}, {}, {}, {});
  EXPECT_EQ(residuals.unmapped(), 27);  // up to 40 degrees on either side it is within 7 m
  map = map_of(
      {{Vector2d(4.0, -30.0), Vector2d(4.0, 30.0)}, {Vector2d(-4.0, -30.0), Vector2d(-4.0, 30.0)}});
  residuals.compute(map, {}, {}, {}, {});
  EXPECT_EQ(residuals.unmapped(), 14);  // up to 50 degrees, before and behind
}

TEST(BeamResiduals, FlatBeamsAreLeftOut) {
  const LineMap map = map_of({{Vector2d(2.0, -15.0), Vector2d(2.0, 15.0)}});
  RefinementOptions options;
  for (const double degrees : {75.0, 55.0, 15.0}) {
    options.max_incidence_rad = radians(degrees);
    const std::vector<BeamResidual> beams = beams_of(star(19.0), map, options);
    EXPECT_EQ(beams.size(), 1u + 2u * static_cast<std::size_t>(degrees / 10.0));
  }
}

/// A wall, and another so far behind it.
LineMap doubled_wall(double apart) {
  return map_of({{Vector2d(5.0, -6.0), Vector2d(5.0, 6.0)},
                 {Vector2d(5.0 + apart, -6.0), Vector2d(5.0 + apart, 6.0)}});
}

TEST(BeamResiduals, ANeighbourExplainsABeamBetter) {
  const BeamResidual beam = beams_of(star(5.05), doubled_wall(0.05)).front();
  EXPECT_NEAR(beam.residual, 0.0, 1e-9);
  EXPECT_NEAR(beam.range, 5.05, 1e-9);
  EXPECT_NEAR(beam.hit.x(), 5.05, 1e-9);
  EXPECT_NEAR(beam.gradient.x(), -1.0, 1e-9);
}

TEST(BeamResiduals, NoNeighbourIsAskedWhereTheNoiseExplainsAll) {
  EXPECT_NEAR(beams_of(star(5.015), doubled_wall(0.02)).front().residual, 0.015, 1e-9);
}

TEST(BeamResiduals, AWallBeyondReachIsNoNeighbour) {
  RefinementOptions options;
  options.neighbour_reach_m = 0.3;
  const BeamResidual near = beams_of(star(5.29), doubled_wall(0.29), options).front();
  EXPECT_NEAR(near.residual, 0.0, 1e-9);
  EXPECT_FALSE(near.is_beyond);
  const BeamResidual far = beams_of(star(5.31), doubled_wall(0.31), options).front();
  EXPECT_NEAR(far.residual, 0.0, 1e-9);
  EXPECT_TRUE(far.is_beyond);
}

TEST(BeamResiduals, ABeamThroughAWallMeetsTheOneAtItsEnd) {
  const BeamResidual met = beams_of(star(8.1), doubled_wall(3.0)).front();
  EXPECT_TRUE(met.is_beyond);
  EXPECT_NEAR(met.residual, 0.1, 1e-9);
  EXPECT_NEAR(met.range, 8.0, 1e-9);
  EXPECT_NEAR(met.hit.x(), 8.0, 1e-9);
}

TEST(BeamResiduals, ABeamThroughAWallThatEndsNowhereMeetsNothing) {
  for (const double range : {7.6, 8.4}) {
    const BeamResidual beam = beams_of(star(range), doubled_wall(3.0)).front();
    EXPECT_FALSE(beam.is_beyond);
    EXPECT_NEAR(beam.residual, range - 5.0, 1e-9);
  }
}

TEST(BeamResiduals, ANeighbourEndsWhereItEnds) {
  const LineMap map =
      map_of({{Vector2d(5.0, -6.0), Vector2d(5.0, 6.0)}, {Vector2d(5.1, 1.0), Vector2d(5.1, 6.0)}});
  const std::vector<BeamResidual> beams = beams_of(star(5.1), map);
  EXPECT_EQ(beams[0].beam, 0);
  EXPECT_NEAR(beams[0].residual, 0.1, 1e-9);
  LaserScan aside = star(5.1 / std::cos(radians(20.0)));
  EXPECT_NEAR(beams_of(aside, map)[2].residual, 0.0, 1e-9);
}

TEST(BeamResiduals, WhichOfTwoWallsABeamMetIsNoSurerThanThePose) {
  const LineMap map = map_of(
      {{Vector2d(5.0, -6.0), Vector2d(5.0, 6.0)}, {Vector2d(5.2, -6.0), Vector2d(5.2, 6.0)}});
  const LaserScan scan = star(5.15);
  BeamResiduals residuals;
  residuals.set_scan(scan, fine_scanner());
  const auto straight_ahead = [&](const WallDoubt& doubt) {
    residuals.compute(map, {}, {}, {}, {}, 1, doubt);
    return residuals.beams().front();
  };
  const BeamResidual nearest = straight_ahead({});
  EXPECT_NEAR(nearest.residual, -0.05, 1e-9);
  EXPECT_EQ(nearest.wall_variance, 0.0);
  // The other wall is 0.15 m off, this one 0.05 m: by exp(-(0.15² - 0.05²) / (2 sigma²)).
  const auto expect_mixture = [](const BeamResidual& beam, double variance) {
    const double other = std::exp(-0.5 * (0.0225 - 0.0025) / variance);
    const double mean = (-0.05 + 0.15 * other) / (1.0 + other);
    EXPECT_NEAR(beam.residual, mean, 1e-9);
    EXPECT_NEAR(beam.wall_variance, 0.04 * other / ((1.0 + other) * (1.0 + other)), 1e-9);
  };
  expect_mixture(straight_ahead({Matrix3d::Zero(), 0.06, 0.0, 0.08}), 0.01);
  const Vector3d pose(0.0064, 1.0, 1.0);  // only what lies along the beam counts
  expect_mixture(straight_ahead({pose.asDiagonal(), 0.06, 0.0, 0.0}), 0.01);
}

TEST(BeamResiduals, AnotherFanOfAsManyBeamsIsAnotherFan) {
  const LineMap map = map_of({{Vector2d(5.0, -6.0), Vector2d(5.0, 6.0)}});
  BeamResiduals residuals;
  LaserScan scan = star(5.0);
  residuals.set_scan(scan, fine_scanner());
  residuals.compute(map, {}, {}, {}, {});
  scan.first_bearing = radians(-5.0);
  residuals.set_scan(scan, fine_scanner());
  residuals.compute(map, {}, {}, {}, {});
  EXPECT_NEAR(residuals.beams().front().range, 5.0 / std::cos(radians(5.0)), 1e-9);
}

TEST(BeamResiduals, UnevenBearingsAreThoseOfTheScan) {
  const LineMap map = map_of({{Vector2d(5.0, -20.0), Vector2d(5.0, 20.0)}});
  BeamResiduals residuals;
  LaserScan scan = star(5.0);
  residuals.set_scan(scan, fine_scanner());
  residuals.compute(map, {}, {}, {}, {});
  for (int i = 0; i < 36; ++i) {
    scan.bearings.push_back(radians(10.0 * i + (i % 2 == 0 ? 1.0 : -2.0)));
  }
  residuals.set_scan(scan, fine_scanner());
  residuals.compute(map, {}, {}, {}, {});
  EXPECT_NEAR(residuals.beams()[0].range, 5.0 / std::cos(radians(1.0)), 1e-9);
  EXPECT_NEAR(residuals.beams()[1].range, 5.0 / std::cos(radians(8.0)), 1e-9);
}

}  // namespace
}  // namespace adit
