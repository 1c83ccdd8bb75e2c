// Whether the fit is as good as physics allows, and its information what its errors are.
#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "adit/information/bound.hpp"
#include "adit/refinement/refinement.hpp"
#include "adit/simulation/random.hpp"
#include "support/casting.hpp"
#include "support/draws.hpp"
#include "support/repeats.hpp"

namespace adit {
namespace {

using testing::cast_at;
using testing::kInfinity;
using testing::map_of;

using Walls = std::vector<Segment>;

constexpr int kBeams = 360;
const Pose2 kMounting{0.5, -0.3, radians(20.0)};
const MapError kPerfect{0.0, 1.5, 0.0};

Walls room() {
  const std::vector<Vector2d> corners{{0, 0},  {9, 1},  {8, 4},  {12, 5}, {11, 9},
                                      {5, 10}, {4, 13}, {2, 12}, {1, 7},  {-2, 5}};
  Walls walls;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    walls.push_back({corners[i], corners[(i + 1) % corners.size()]});
  }
  return walls;
}

Pose2 random_pose(Random& random) {
  return {random.uniform(2.5, 6.5), random.uniform(3.0, 7.5), random.uniform(-kPi, kPi)};
}

/// The walls as rock has them: their offsets an Ornstein-Uhlenbeck process along each.
Walls displaced(const Walls& plan, const MapError& error, Random& random) {
  constexpr double kPiece = 0.1;
  const double kept = std::exp(-kPiece / error.length_m);
  Walls rock;
  for (const Segment& wall : plan) {
    const auto pieces = static_cast<int>(std::ceil(wall.length() / kPiece));
    const Vector2d step = (wall.b - wall.a) / pieces;
    const Vector2d normal = perpendicular(step.normalized());
    double offset = error.offset_sigma_m * random.normal();
    for (int i = 0; i < pieces; ++i) {
      const Vector2d begin = wall.a + i * step + offset * normal;
      offset =
          kept * offset + std::sqrt(1.0 - kept * kept) * error.offset_sigma_m * random.normal();
      rock.push_back({begin, wall.a + (i + 1) * step + offset * normal});
    }
  }
  return rock;
}

ScannerModel scanner(double sweep_s = 0.0, SweepMoment stamp = SweepMoment::middle) {
  ScannerModel model;
  model.range_sigma_m = 0.02;
  model.quantisation_m = 0.0;
  model.max_range_m = 50.0;
  model.sweep_s = sweep_s;
  model.stamp = stamp;
  return model;
}

double bearing_of(int beam) { return -kPi + beam * kTwoPi / kBeams; }

/// The laser at the time of a beam.
Pose2 laser_at(const Pose2& vehicle, const Twist2& twist, const ScannerModel& model, int beam) {
  const double tau = sweep_timing(model, kBeams).at(static_cast<std::size_t>(beam));
  return vehicle * moved(twist, tau) * kMounting;
}

double cast(const Walls& walls, const Pose2& laser, double bearing) {
  const Vector2d direction = unit_vector(laser.theta + bearing);
  double range = kInfinity;
  for (const Segment& wall : walls) {
    range = std::min(range, cast_at(wall, laser.translation(), direction));
  }
  return range;
}

LaserScan sweep(const Walls& walls, const Pose2& vehicle, const Twist2& twist,
                const ScannerModel& model, double noise_m, Random& random) {
  LaserScan scan;
  scan.first_bearing = bearing_of(0);
  scan.bearing_step = kTwoPi / kBeams;
  scan.max_range = 50.0;
  scan.vehicle_from_laser = kMounting;
  for (int i = 0; i < kBeams; ++i) {
    const double range = cast(walls, laser_at(vehicle, twist, model, i), bearing_of(i));
    scan.ranges.push_back(std::min(range + noise_m * random.normal(), 50.0));
  }
  return scan;
}

/// A start near the truth; the prior says next to nothing.
PoseWithCovariance start_near(const Pose2& truth, Random& random) {
  const Vector3d sigmas(0.03, 0.03, 0.005);
  const Vector3d off = sigmas.cwiseProduct(test::drawn<3>([&] { return random.normal(); }));
  return {Pose2::from_vector(truth.vector() + off), sigmas.cwiseAbs2().asDiagonal()};
}

PoseWithCovariance vague(const PoseWithCovariance& start) {
  return {start.pose, 1e4 * start.covariance};
}

Vector3d error_of(const ScanFit& fit, const Pose2& truth) {
  const Vector3d best = fit.pose.vector() + fit.information.ldlt().solve(fit.score);
  return {best.x() - truth.x, best.y() - truth.y, angle_between(truth.theta, best.z())};
}

/// Errors of many fits, compared with what they say of themselves and with the bound.
struct Statistics {
  double nees = 0.0;           ///< per degree of freedom
  double over_bound = 0.0;     ///< squared error in units of the bound, per degree of freedom
  double least_stated = 10.0;  ///< stated information against the bound's, the worst direction
  double most_stated = 0.0;
  double rms_m = 0.0;
  double rms_rad = 0.0;
  int converged = 0;
  int count = 0;
};

// A beam along a wall would hold most of the information on one side of this limit and none on the
// other; so the fit and the bound both leave out what is flatter than where such beams begin.
constexpr double kFlat = radians(80.0);

RefinementOptions options() {
  RefinementOptions result;
  result.max_incidence_rad = kFlat;
  return result;
}

void add_bound(const LineMap& map, const Pose2& truth, const ScanFit& fit, Statistics& sum) {
  BoundWorkspace workspace;
  const BeamFan fan{bearing_of(0), kTwoPi / kBeams, kBeams, kMounting};
  BoundOptions bound_options;
  bound_options.max_incidence_rad = kFlat;
  const PoseBound bound = cramer_rao(map, truth, scanner(), fan, bound_options, workspace);
  const Vector3d error = error_of(fit, truth);
  sum.over_bound += error.dot(bound.information * error) / 3.0;
  // In units in which the bound is the unit matrix.
  const Matrix3d root = bound.information.llt().matrixL();
  const Matrix3d stated = root.inverse() * fit.information * root.inverse().transpose();
  sum.least_stated = std::min(sum.least_stated, 1.0 / stated.inverse().norm() * std::sqrt(3.0));
  sum.most_stated = std::max(sum.most_stated, stated.norm() / std::sqrt(3.0));
}

void finish(Statistics& sum) {
  sum.nees /= sum.count;
  sum.over_bound /= sum.count;
  sum.rms_m = std::sqrt(sum.rms_m / sum.count);
  sum.rms_rad = std::sqrt(sum.rms_rad / sum.count);
}

void add_fit(const ScanFit& fit, const Pose2& truth, Statistics& sum) {
  const Vector3d error = error_of(fit, truth);
  sum.nees += error.dot(fit.information * error) / 3.0;
  sum.rms_m += error.head<2>().squaredNorm();
  sum.rms_rad += error.z() * error.z();
  sum.converged += fit.converged ? 1 : 0;
  ++sum.count;
}

Statistics fit_at_rest(const MapError& error, double noise_m, int scans) {
  Random random(21);
  const Walls plan = room();
  const LineMap map = map_of(plan);
  const ScannerModel model = scanner();
  Refiner refiner;
  Statistics sum;
  for (int i = 0; i < scans; ++i) {
    const Walls rock = error.offset_sigma_m > 0.0 ? displaced(plan, error, random) : plan;
    const Pose2 truth = random_pose(random);
    const LaserScan scan = sweep(rock, truth, {}, model, noise_m, random);
    const PoseWithCovariance start = start_near(truth, random);
    const ScanFit& fit =
        refiner.refine({map, scan, model, error, {}}, vague(start), start, options());
    add_fit(fit, truth, sum);
    add_bound(map, truth, fit, sum);
  }
  finish(sum);
  return sum;
}

TEST(RefinementStatistics, OnAPerfectMapTheInformationIsTheBound) {
  const Statistics perfect = fit_at_rest(kPerfect, 0.0, test::repeats(200));
  EXPECT_GT(perfect.least_stated, 0.95);
  EXPECT_LT(perfect.most_stated, 1.05);
}

TEST(RefinementStatistics, OnAPerfectMapTheErrorReachesTheBound) {
  const Statistics noisy = fit_at_rest(kPerfect, 0.02, test::repeats(500));
  EXPECT_LT(noisy.over_bound, 1.2);
  EXPECT_GT(noisy.nees, 0.8);
  EXPECT_LT(noisy.nees, 1.2);
  EXPECT_EQ(noisy.converged, noisy.count);
}

TEST(RefinementStatistics, OnWallsThatErrTogetherTheCovarianceIsHonest) {
  const Statistics rough = fit_at_rest({0.05, 1.5, 0.0}, 0.02, test::repeats(300));
  EXPECT_GT(rough.nees, 0.7);
  EXPECT_LT(rough.nees, 1.3);
  // As if each beam erred for itself, the covariance would be far too small.
  EXPECT_GT(rough.over_bound, 5.0);
}

const Twist2 kDrive{5.0, 0.0, radians(45.0)};

/// The drive as wheels report it whose mean speed errs by this part, one sigma: steadily in each
/// half of the sweep, and in the two not independently.
SweepPrior odometry_of(double error_ratio, const ScannerModel& model, Random& random) {
  const Vector3d sigmas = error_ratio * Vector3d(kDrive.vx, 0.2 * kDrive.vx, kDrive.omega);
  SweepPrior odometry;
  odometry.covariance = sigmas.cwiseAbs2().asDiagonal();
  odometry.path = steady_path(kDrive, sweep_timing(model, kBeams), kBeams);
  SweepCorrection error;
  error.middle_s = odometry.path.begin_s + 0.5 * odometry.path.span_s;
  const auto draw = [&] { return test::drawn<3>([&] { return random.normal(); }); };
  const Vector3d shared = draw();
  for (Twist2& half : error.halves) {
    const Vector3d mixed = std::sqrt(0.5) * shared + draw();
    half = Twist2::from_vector(sigmas.cwiseProduct(mixed));
  }
  for (std::size_t k = 0; k < odometry.path.stamp_from_vehicle.size(); ++k) {
    Pose2& pose = odometry.path.stamp_from_vehicle[k];
    pose = pose * error.at(odometry.path.time(k));
  }
  return odometry;
}

/// How far the vehicle is at the begin and the end of the sweep from where it should be, seen from
/// where it is at the stamp: the mean square (m²), with a metre of lever for the heading.
double path_error(const SweepPath& path, const SweepCorrection& correction) {
  double sum = 0.0;
  for (const double tau : {path.begin_s, path.begin_s + path.span_s}) {
    const Pose2 off = inverse(moved(kDrive, tau)) * correction.at(tau) * path.at(tau);
    sum += 0.5 * off.vector().squaredNorm();
  }
  return sum;
}

/// What fits say of the motion during the sweep, against what the wheels said.
struct Motion {
  double reported = 0.0;  ///< error of the path (m, RMS)
  double found = 0.0;
};

Statistics fit_on_the_move(SweepMoment stamp, double odometry_error, Motion& motion) {
  constexpr int kScans = test::repeats(300);
  Random random(22);
  const Walls plan = room();
  const LineMap map = map_of(plan);
  const ScannerModel model = scanner(0.2, stamp);
  Refiner refiner;
  Statistics sum;
  for (int i = 0; i < kScans; ++i) {
    const Pose2 truth = random_pose(random);
    const LaserScan scan = sweep(plan, truth, kDrive, model, 0.02, random);
    const PoseWithCovariance start = start_near(truth, random);
    const SweepPrior odometry = odometry_of(odometry_error, model, random);
    const ScanFit& fit =
        refiner.refine({map, scan, model, kPerfect, odometry}, vague(start), start, options());
    add_fit(fit, truth, sum);
    motion.reported += path_error(odometry.path, {});
    motion.found += path_error(odometry.path, fit.correction);
  }
  finish(sum);
  motion.reported = std::sqrt(motion.reported / kScans);
  motion.found = std::sqrt(motion.found / kScans);
  return sum;
}

class Stamps : public ::testing::TestWithParam<SweepMoment> {};

TEST_P(Stamps, AMovingScanTellsPoseAndMotion) {
  Motion motion;
  const Statistics moving = fit_on_the_move(GetParam(), 0.1, motion);
  EXPECT_GT(moving.nees, 0.7);
  EXPECT_LT(moving.nees, 1.3);
  EXPECT_GT(moving.converged, 0.98 * moving.count);
  EXPECT_GT(motion.reported, 0.05);
  EXPECT_LT(motion.found, 0.25 * motion.reported);
}

TEST_P(Stamps, APerfectMovingScanIsFittedExactly) {
  Random random(23);
  const Walls plan = room();
  const LineMap map = map_of(plan);
  const ScannerModel model = scanner(0.2, GetParam());
  Refiner refiner;
  double worst_m = 0.0;
  double worst_path = 0.0;
  for (int trial = 0; trial < test::repeats(50); ++trial) {
    const Pose2 truth = random_pose(random);
    const LaserScan scan = sweep(plan, truth, kDrive, model, 0.0, random);
    const PoseWithCovariance start = start_near(truth, random);
    const SweepPrior odometry = odometry_of(0.1, model, random);
    const ScanFit& fit =
        refiner.refine({map, scan, model, kPerfect, odometry}, vague(start), start, options());
    worst_m = std::max(worst_m, error_of(fit, truth).head<2>().norm());
    worst_path = std::max(worst_path, path_error(odometry.path, fit.correction));
  }
  EXPECT_LT(worst_m, 0.02);
  EXPECT_LT(std::sqrt(worst_path), 0.05);
}

TEST(RefinementStatistics, WithGoodWheelsAMovingScanIsHalfAsGoodAsOneAtRest) {
  Motion motion;
  const Statistics moving = fit_on_the_move(SweepMoment::middle, 0.02, motion);
  const Statistics standing = fit_at_rest(kPerfect, 0.02, test::repeats(300));
  EXPECT_LT(moving.rms_m, 2.0 * standing.rms_m);
  EXPECT_GT(moving.nees, 0.7);
  EXPECT_LT(moving.nees, 1.3);
}

INSTANTIATE_TEST_SUITE_P(RefinementStatistics, Stamps,
                         ::testing::Values(SweepMoment::start, SweepMoment::middle,
                                           SweepMoment::end));

}  // namespace
}  // namespace adit
