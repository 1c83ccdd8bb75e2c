#include "adit/information/beam.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "adit/geometry/pose2.hpp"

namespace adit {
namespace {

/// Range from the laser to the infinite line n . x = offset.
double range_to_line(const Pose2& map_from_laser, double bearing, const Vector2d& normal,
                     double offset) {
  const Vector2d direction = unit_vector(map_from_laser.theta + bearing);
  return (offset - normal.dot(map_from_laser.translation())) / normal.dot(direction);
}

double any_between(double low, double high) {
  return low + (high - low) * *rc::gen::inRange(0, 1000001) / 1e6;
}

TEST(BeamVariance, AddsTheFourSources) {
  ScannerModel scanner;
  scanner.range_sigma_m = 0.3;
  scanner.quantisation_m = 0.6;
  scanner.bearing_sigma_rad = 0.01;
  // Incidence 60 degrees: cos 1/2, tan² 3. 0.09 + 0.36/12 + (0.1 * 2)² + (20 * 0.01)² * 3.
  EXPECT_NEAR(beam_variance(scanner, 20.0, 0.5, 0.1), 0.09 + 0.03 + 0.04 + 0.12, 1e-12);
  EXPECT_NEAR(beam_variance(scanner, 20.0, -0.5, 0.1), 0.28, 1e-12);
  EXPECT_NEAR(beam_variance(scanner, 20.0, 1.0, 0.0), 0.12, 1e-12);
}

TEST(BeamVariance, RoundingUpTheCosineDoesNotMakeItNegative) {
  ScannerModel scanner;
  scanner.bearing_sigma_rad = 1.0;
  EXPECT_GE(beam_variance(scanner, 1e6, 1.0 + 1e-15, 0.0),
            scanner.beam_sigma_m() * scanner.beam_sigma_m() * (1.0 - 1e-12));
}

TEST(BeamVariance, WallEdgeOnTellsNothing) {
  EXPECT_EQ(beam_variance(ScannerModel{}, 5.0, 0.0, 0.0), std::numeric_limits<double>::infinity());
}

TEST(RangeGradient, StandingBeforeAWall) {
  // Two metres before the wall x = 2: a step towards it shortens the range, a turn does not.
  const Vector3d ahead = range_gradient(2.0, {1.0, 0.0}, {1.0, 0.0});
  EXPECT_TRUE(ahead.isApprox(Vector3d(-1.0, 0.0, 0.0)));
  // Looking 45 degrees left: range 2 sqrt 2, and dr/dtheta = r tan 45°.
  const Vector3d aslant = range_gradient(2.0 * std::sqrt(2.0), unit_vector(radians(45.0)), {1, 0});
  EXPECT_TRUE(aslant.isApprox(Vector3d(-std::sqrt(2.0), 0.0, 2.0 * std::sqrt(2.0))));
}

RC_GTEST_PROP(RangeGradient, IsTheNumericDerivativeOnAnyWall, ()) {
  const Pose2 map_from_vehicle{any_between(-50, 50), any_between(-50, 50), any_between(-3, 3)};
  const Pose2 vehicle_from_laser{any_between(-2, 2), any_between(-2, 2), any_between(-3, 3)};
  const double bearing = any_between(-3, 3);
  const Vector2d normal = unit_vector(any_between(-3, 3));
  const Pose2 map_from_laser = map_from_vehicle * vehicle_from_laser;
  const Vector2d direction = unit_vector(map_from_laser.theta + bearing);
  RC_PRE(std::abs(normal.dot(direction)) > 0.05);
  const double range = any_between(0.5, 60);
  const double offset = normal.dot(map_from_laser.translation() + range * direction);

  const Vector3d of_laser = range_gradient(range, direction, normal);
  const Vector3d of_vehicle = range_gradient(
      range, direction, normal, map_from_laser.translation() - map_from_vehicle.translation());
  RC_ASSERT(of_laser.isApprox(range_gradient(range, direction, -normal), 1e-12));

  constexpr double kStep = 1e-6;
  for (int axis = 0; axis < 3; ++axis) {
    const auto moved = [axis](const Pose2& pose, double by) {
      return Pose2::from_vector(pose.vector() + by * Vector3d::Unit(axis));
    };
    const auto slope = [&](auto&& range_at) {
      return (range_at(kStep) - range_at(-kStep)) / (2.0 * kStep);
    };
    const double laser_slope = slope([&](double by) {
      return range_to_line(moved(map_from_laser, by), bearing, normal, offset);
    });
    const double vehicle_slope = slope([&](double by) {
      return range_to_line(moved(map_from_vehicle, by) * vehicle_from_laser, bearing, normal,
                           offset);
    });
    const double tolerance = 1e-6 * (1.0 + of_vehicle.norm() + of_laser.norm());
    RC_ASSERT(std::abs(of_laser(axis) - laser_slope) < tolerance);
    RC_ASSERT(std::abs(of_vehicle(axis) - vehicle_slope) < tolerance);
  }
}

}  // namespace
}  // namespace adit
