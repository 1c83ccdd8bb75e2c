#include "adit/information/bound.hpp"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <limits>
#include <random>

#include "adit/information/beam.hpp"

namespace adit {
namespace {

using World = std::vector<Segment>;

struct Hit {
  double range = std::numeric_limits<double>::infinity();
  Vector2d normal = Vector2d::Zero();
};

/// The oracle: every beam against every wall.
Hit cast(const World& world, const Vector2d& from, const Vector2d& direction) {
  Hit hit;
  for (const Segment& wall : world) {
    const Vector2d along = wall.b - wall.a;
    const double denominator = cross(direction, along);
    if (denominator == 0.0) continue;
    const double range = cross(wall.a - from, along) / denominator;
    const double place = cross(wall.a - from, direction) / denominator;
    if (range > 0.0 && place >= 0.0 && place <= 1.0 && range < hit.range) {
      hit = {range, perpendicular(along).normalized()};
    }
  }
  return hit;
}

World loop(const std::vector<Vector2d>& corners) {
  World world;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    world.push_back({corners[i], corners[(i + 1) % corners.size()]});
  }
  return world;
}

World room() { return loop({{0, 0}, {8, 1}, {7, 6}, {1, 5}}); }

World room_with_column() {
  World world = room();
  for (const Segment& side : loop({{5, 2.6}, {5.4, 2.6}, {5.4, 3}, {5, 3}})) world.push_back(side);
  return world;
}

LineMap map_of(const World& world) { return LineMap::build(world); }

const Pose2 kStand{3.1, 2.7, 0.4};

double bearing_of(const BeamFan& fan, int beam) {
  return fan.first_bearing + beam * fan.bearing_step;
}

/// Information from numeric derivatives of brute-force ranges.
Matrix3d numeric_information(const World& world, const Pose2& map_from_vehicle,
                             const ScannerModel& scanner, const BeamFan& fan, double map_sigma_m) {
  constexpr double kStep = 1e-6;
  Matrix3d information = Matrix3d::Zero();
  for (int beam = 0; beam < fan.count; ++beam) {
    const auto cast_from = [&](const Pose2& vehicle) {
      const Pose2 laser = vehicle * fan.vehicle_from_laser;
      return cast(world, laser.translation(), unit_vector(laser.theta + bearing_of(fan, beam)));
    };
    const Hit here = cast_from(map_from_vehicle);
    if (!(here.range < scanner.max_range_m)) continue;
    Vector3d g;
    for (int axis = 0; axis < 3; ++axis) {
      const auto range_at = [&](double by) {
        return cast_from(Pose2::from_vector(map_from_vehicle.vector() + by * Vector3d::Unit(axis)))
            .range;
      };
      g(axis) = (range_at(kStep) - range_at(-kStep)) / (2.0 * kStep);
    }
    const double theta = (map_from_vehicle * fan.vehicle_from_laser).theta;
    const double cosine = here.normal.dot(unit_vector(theta + bearing_of(fan, beam)));
    information += g * g.transpose() / beam_variance(scanner, here.range, cosine, map_sigma_m);
  }
  return information;
}

/// Weighted Gauss-Newton over brute-force ranges.
Pose2 fit(const World& world, const Pose2& start, const ScannerModel& scanner, const BeamFan& fan,
          double map_sigma_m, const std::vector<double>& measured) {
  Pose2 vehicle = start;
  for (int iteration = 0; iteration < 4; ++iteration) {
    const Pose2 laser = vehicle * fan.vehicle_from_laser;
    Matrix3d normal_matrix = Matrix3d::Zero();
    Vector3d right = Vector3d::Zero();
    for (int beam = 0; beam < fan.count; ++beam) {
      const Vector2d direction = unit_vector(laser.theta + bearing_of(fan, beam));
      const Hit hit = cast(world, laser.translation(), direction);
      const Vector3d g = range_gradient(hit.range, direction, hit.normal,
                                        laser.translation() - vehicle.translation());
      const double weight =
          1.0 / beam_variance(scanner, hit.range, hit.normal.dot(direction), map_sigma_m);
      normal_matrix += weight * g * g.transpose();
      right += weight * (measured[static_cast<std::size_t>(beam)] - hit.range) * g;
    }
    vehicle = Pose2::from_vector(vehicle.vector() + normal_matrix.ldlt().solve(right));
  }
  return vehicle;
}

/// Simulates scans and fits them; the errors whitened by the bound must have unit covariance.
void expect_fits_reach_bound(const ScannerModel& scanner, const BeamFan& fan, double map_sigma_m) {
  const World world = room();
  BoundOptions options;
  options.map_sigma_m = map_sigma_m;
  BoundWorkspace workspace;
  const PoseBound bound = cramer_rao(map_of(world), kStand, scanner, fan, options, workspace);
  ASSERT_EQ(bound.rank, 3);
  ASSERT_EQ(bound.beams, fan.count);
  const Matrix3d lower = bound.covariance->llt().matrixL();

  constexpr int kFits = 1000;
  std::mt19937_64 random(7);
  std::normal_distribution<double> normal;
  const Pose2 laser = kStand * fan.vehicle_from_laser;
  Matrix3d second_moment = Matrix3d::Zero();
  Vector3d mean = Vector3d::Zero();
  std::vector<double> measured(static_cast<std::size_t>(fan.count));
  for (int i = 0; i < kFits; ++i) {
    for (int beam = 0; beam < fan.count; ++beam) {
      const double off_bearing = scanner.bearing_sigma_rad * normal(random);
      const Vector2d direction = unit_vector(laser.theta + bearing_of(fan, beam) + off_bearing);
      const Hit hit = cast(world, laser.translation(), direction);
      const double off_wall = map_sigma_m * normal(random) / hit.normal.dot(direction);
      const double range = hit.range + off_wall + scanner.range_sigma_m * normal(random);
      const double step = scanner.quantisation_m;
      measured[static_cast<std::size_t>(beam)] =
          step > 0.0 ? step * std::round(range / step) : range;
    }
    const Pose2 found = fit(world, kStand, scanner, fan, map_sigma_m, measured);
    const Vector3d error(found.x - kStand.x, found.y - kStand.y,
                         angle_between(kStand.theta, found.theta));
    const Vector3d white = lower.triangularView<Eigen::Lower>().solve(error);
    mean += white / kFits;
    second_moment += white * white.transpose() / kFits;
  }
  // Sampling errors of 1000 fits, four sigma: 1/sqrt(N) of a mean and a correlation, sqrt(2/N) of
  // a variance.
  const double sigma = 1.0 / std::sqrt(kFits);
  for (int i = 0; i < 3; ++i) {
    EXPECT_NEAR(mean(i), 0.0, 4.0 * sigma) << "axis " << i;
    EXPECT_NEAR(second_moment(i, i), 1.0, 4.0 * std::sqrt(2.0) * sigma) << "axis " << i;
    for (int j = 0; j < i; ++j) EXPECT_NEAR(second_moment(i, j), 0.0, 4.0 * sigma) << i << j;
  }
}

TEST(CramerRao, ThousandFitsReachTheBoundOfRangeNoise) {
  ScannerModel scanner;
  scanner.range_sigma_m = 0.02;
  scanner.quantisation_m = 0.0;
  expect_fits_reach_bound(scanner, {-kPi, kTwoPi / 180.0, 180, {}}, 0.0);
}

TEST(CramerRao, ThousandFitsReachTheBoundOfAllNoisesAndAMountedLaser) {
  ScannerModel scanner;
  scanner.range_sigma_m = 0.01;
  scanner.quantisation_m = 0.02;
  scanner.bearing_sigma_rad = 0.002;
  expect_fits_reach_bound(scanner, {-2.0, radians(1.0), 230, {0.7, -0.3, 0.5}}, 0.01);
}

TEST(CramerRao, MatchesNumericDerivativesOfBruteForce) {
  const World world = room_with_column();
  const LineMap map = map_of(world);
  ScannerModel scanner;
  scanner.bearing_sigma_rad = 0.003;
  BoundWorkspace workspace;
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  BoundOptions options;
  options.map_sigma_m = 0.01;
  options.max_incidence_rad = radians(90.0);
  for (int i = 0; i < 100; ++i) {
    const Pose2 pose{3.0 + uniform(random), 3.0 + uniform(random), kPi * uniform(random)};
    BeamFan fan{kPi * uniform(random), radians(0.7) * uniform(random), 300, {}};
    fan.vehicle_from_laser = {0.5 * uniform(random), 0.5 * uniform(random), kPi * uniform(random)};
    const Matrix3d expected = numeric_information(world, pose, scanner, fan, options.map_sigma_m);
    const PoseBound bound = cramer_rao(map, pose, scanner, fan, options, workspace);
    EXPECT_LT((bound.information - expected).norm(), 1e-4 * expected.norm()) << "world " << i;
    EXPECT_EQ(bound.beams, fan.count);
  }
}

TEST(CramerRao, CovarianceIsTheInverse) {
  BoundWorkspace workspace;
  const PoseBound bound = cramer_rao(map_of(room()), kStand, {}, {}, {}, workspace);
  ASSERT_TRUE(bound.covariance);
  EXPECT_LT((bound.information * *bound.covariance - Matrix3d::Identity()).norm(), 1e-9);
  EXPECT_EQ(bound.beams, 1000);
  EXPECT_EQ(bound.edge_beams, 0);
}

TEST(CramerRao, ClockwiseScannerKnowsTheSame) {
  BoundWorkspace workspace;
  const LineMap map = map_of(room_with_column());
  const BeamFan fan{-1.0, 0.01, 201, {0.2, 0.1, 0.3}};
  const BeamFan reversed{1.0, -0.01, 201, {0.2, 0.1, 0.3}};
  const PoseBound a = cramer_rao(map, kStand, {}, fan, {}, workspace);
  const PoseBound b = cramer_rao(map, kStand, {}, reversed, {}, workspace);
  EXPECT_TRUE(a.information.isApprox(b.information, 1e-9));
  EXPECT_EQ(a.edge_beams, b.edge_beams);
}

TEST(CramerRao, BeamsBesideADepthEdgeCanBeLeftOut) {
  BoundWorkspace workspace;
  const LineMap map = map_of(room_with_column());
  BoundOptions options;
  const PoseBound all = cramer_rao(map, kStand, {}, {}, options, workspace);
  options.use_edge_beams = false;
  const PoseBound inner = cramer_rao(map, kStand, {}, {}, options, workspace);
  // The column has a left and a right silhouette; each lies between two beams.
  EXPECT_EQ(all.edge_beams, 4);
  EXPECT_EQ(inner.edge_beams, 4);
  EXPECT_EQ(all.beams, 1000);
  EXPECT_EQ(inner.beams, 996);
}

/// Directions that a plan leaves open are reported, not divided by.
struct OpenCase {
  const char* name;
  World world;
  int rank;
};

TEST(CramerRao, UnobservableDirectionsLeaveNoCovariance) {
  const double far = 200.0;
  const Vector2d along = unit_vector(0.5);
  const Vector2d across = perpendicular(along);
  const OpenCase cases[] = {
      {"nothing", {}, 0},
      {"drift", {{{-far, -2}, {far, -2}}, {{-far, 2}, {far, 2}}}, 2},
      {"turned drift",
       {{-far * along - 2 * across, far * along - 2 * across},
        {-far * along + 2 * across, far * along + 2 * across}},
       2},
      {"one wall", {{{-far, -2}, {far, -2}}}, 2},
      {"one wall ahead of a single beam", {{{3, -far}, {3, far}}}, 1},
  };
  BoundWorkspace workspace;
  for (const OpenCase& open : cases) {
    BeamFan fan;
    if (open.rank == 1) fan = {0.0, 0.1, 1, {}};
    const PoseBound bound = cramer_rao(map_of(open.world), {0.3, 0.4, 0.1}, {}, fan, {}, workspace);
    EXPECT_EQ(bound.rank, open.rank) << open.name;
    EXPECT_FALSE(bound.covariance) << open.name;
    EXPECT_TRUE(bound.information.allFinite()) << open.name;
  }
}

TEST(CramerRao, EndOfADriftMakesItObservable) {
  const World world{{{-200, -2}, {12, -2}}, {{-200, 2}, {12, 2}}, {{12, -2}, {12, 2}}};
  BoundWorkspace workspace;
  const PoseBound bound = cramer_rao(map_of(world), {0.0, 0.3, 0.0}, {}, {}, {}, workspace);
  ASSERT_EQ(bound.rank, 3);
  // About 53 of the 1000 beams see the end wall nearly square: sigma / sqrt(53) along the drift.
  const double along = std::sqrt((*bound.covariance)(0, 0));
  EXPECT_NEAR(along, ScannerModel{}.beam_sigma_m() / std::sqrt(53.0), 0.1 * along);
}

TEST(CramerRao, NothingBeyondRangeOrFromNowhere) {
  BoundWorkspace workspace;
  ScannerModel near_sighted;
  near_sighted.max_range_m = 0.5;
  EXPECT_EQ(cramer_rao(map_of(room()), kStand, near_sighted, {}, {}, workspace).beams, 0);
  const Pose2 nowhere{std::numeric_limits<double>::quiet_NaN(), 0.0, 0.0};
  EXPECT_EQ(cramer_rao(map_of(room()), nowhere, {}, {}, {}, workspace).rank, 0);
  BeamFan blind;
  blind.count = 0;
  EXPECT_EQ(cramer_rao(map_of(room()), kStand, {}, blind, {}, workspace).rank, 0);
}

TEST(InformationRank, IsIndifferentToUnits) {
  std::optional<Matrix3d> inverse;
  EXPECT_EQ(information_rank(Vector3d(1e-12, 1e12, 1.0).asDiagonal(), &inverse), 3);
  ASSERT_TRUE(inverse);
  EXPECT_NEAR((*inverse)(0, 0) * 1e-12, 1.0, 1e-12);
  EXPECT_EQ(information_rank(Vector3d(0.0, 1e12, 1.0).asDiagonal(), &inverse), 2);
  EXPECT_FALSE(inverse);
}

TEST(BeamFan, IsThatOfTheScan) {
  LaserScan scan;
  scan.first_bearing = -1.0;
  scan.bearing_step = 0.5;
  scan.ranges.resize(5);
  scan.vehicle_from_laser = {1.0, 2.0, 3.0};
  const BeamFan fan = beam_fan(scan);
  EXPECT_EQ(fan.count, 5);
  EXPECT_EQ(fan.first_bearing, -1.0);
  EXPECT_EQ(fan.bearing_step, 0.5);
  EXPECT_EQ(fan.vehicle_from_laser.y, 2.0);
}

}  // namespace
}  // namespace adit
