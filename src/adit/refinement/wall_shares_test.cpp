// What each wall has contributed to a fit, standing and on the move.
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <optional>
#include <vector>

#include "adit/refinement/refinement.hpp"
#include "adit/simulation/random.hpp"
#include "support/casting.hpp"

namespace adit {
namespace {

constexpr int kBeams = 360;
constexpr double kRounding = 1e-10;
const Twist2 kDrive{4.0, 0.0, radians(40.0)};

std::vector<Segment> room() {
  const std::vector<Vector2d> corners{{0, 0},  {9, 1},  {8, 4},  {12, 5}, {11, 9},
                                      {5, 10}, {4, 13}, {2, 12}, {1, 7},  {-2, 5}};
  std::vector<Segment> walls;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    walls.push_back({corners[i], corners[(i + 1) % corners.size()]});
  }
  return walls;
}

ScannerModel scanner(double sweep_s) {
  ScannerModel model;
  model.range_sigma_m = 0.02;
  model.quantisation_m = 0.0;
  model.max_range_m = 50.0;
  model.sweep_s = sweep_s;
  return model;
}

/// Fits in a room, of scans by a scanner that takes all at once or by one on the move.
class InARoom : public ::testing::TestWithParam<MapError> {
 protected:
  /// A scan from the vehicle that drives on as `twist` while its beams are taken.
  LaserScan scan_from(const Pose2& vehicle, const Twist2& twist, const ScannerModel& model) {
    LaserScan scan;
    scan.first_bearing = -kPi;
    scan.bearing_step = kTwoPi / kBeams;
    scan.max_range = 50.0;
    scan.vehicle_from_laser = {0.5, -0.3, radians(20.0)};
    for (std::size_t i = 0; i < kBeams; ++i) {
      const double time = sweep_timing(model, kBeams).at(i);
      const Pose2 laser = vehicle * moved(twist, time) * scan.vehicle_from_laser;
      const Vector2d direction = unit_vector(laser.theta + scan.bearing(i));
      double range = testing::kInfinity;
      for (const Segment& wall : walls_) {
        range = std::min(range, testing::cast_at(wall, laser.translation(), direction));
      }
      scan.ranges.push_back(range + model.range_sigma_m * random_.normal());
    }
    return scan;
  }

  const ScanFit& fit(const ScannerModel& model, const Twist2& twist,
                     const std::optional<SweepPrior>& motion) {
    const Pose2 truth{random_.uniform(2.5, 6.5), random_.uniform(3.0, 7.5),
                      random_.uniform(-kPi, kPi)};
    const LaserScan scan = scan_from(truth, twist, model);
    const PoseWithCovariance start{truth, Vector3d(1e-3, 1e-3, 1e-5).asDiagonal()};
    return refiner_.refine({map_, scan, model, GetParam(), motion}, start, start, {});
  }

  /// Of a scan that takes 0.2 s, the wheels' word on the motion being so good.
  const ScanFit& fit_on_the_move(const Vector3d& sigmas) {
    const ScannerModel model = scanner(0.2);
    const SweepPrior wheels{steady_path(kDrive, sweep_timing(model, kBeams), kBeams),
                            sigmas.cwiseAbs2().asDiagonal()};
    return fit(model, kDrive, wheels);
  }

  Matrix3d sum_of_shares() const {
    Matrix3d sum = Matrix3d::Zero();
    for (const WallShare& share : refiner_.shares()) sum += share.equations.information;
    return sum;
  }

  const std::vector<Segment> walls_ = room();
  const LineMap map_ = testing::map_of(walls_);
  Random random_{41};
  Refiner refiner_;
};

double least_eigenvalue(const Matrix3d& symmetric) {
  return Eigen::SelfAdjointEigenSolver<Matrix3d>(symmetric).eigenvalues().minCoeff();
}

void expect_an_information(const Matrix3d& matrix, double scale) {
  EXPECT_LT((matrix - matrix.transpose()).norm(), kRounding * scale);
  EXPECT_GT(least_eigenvalue(0.5 * (matrix + matrix.transpose())), -kRounding * scale);
}

TEST_P(InARoom, StandingTheWallsAddUpToTheFit) {
  for (int trial = 0; trial < 50; ++trial) {
    const ScanFit& standing = fit(scanner(0.0), {}, {});
    const double scale = standing.information.norm();
    EXPECT_GE(refiner_.shares().size(), 5u);
    for (const WallShare& share : refiner_.shares()) {
      expect_an_information(share.equations.information, scale);
    }
    EXPECT_LT((sum_of_shares() - standing.information).norm(), kRounding * scale);
  }
}

// What is left is dead reckoning's: it says how the beams of a sweep belong together.
TEST_P(InARoom, OnTheMoveTheWallsHaveNoMoreThanTheFit) {
  for (const double doubt : {0.01, 0.1, 1.0}) {
    for (int trial = 0; trial < 50; ++trial) {
      const ScanFit& moving = fit_on_the_move(doubt * Vector3d(4.0, 0.8, 0.7));
      const double scale = moving.information.norm();
      EXPECT_GE(refiner_.shares().size(), 5u);
      for (const WallShare& share : refiner_.shares()) {
        expect_an_information(share.equations.information, scale);
      }
      expect_an_information(moving.information - sum_of_shares(), scale);
      // It has a part where it knows the motion better than the scan does, but never all.
      const double part = 1.0 - sum_of_shares().trace() / moving.information.trace();
      EXPECT_GT(part, 1e-6);
      EXPECT_LT(part, 0.9);
    }
  }
}

// Where the scan must find the motion alone, the walls have all that it says.
TEST_P(InARoom, OnTheMoveWithoutDeadReckoningTheWallsAddUpToTheFit) {
  const ScanFit& moving = fit_on_the_move(Vector3d::Constant(1e4));
  EXPECT_LT((sum_of_shares() - moving.information).norm(), 1e-6 * moving.information.norm());
}

INSTANTIATE_TEST_SUITE_P(WallShares, InARoom,
                         ::testing::Values(MapError{0.0, 1.5, 0.0}, MapError{0.05, 1.5, 0.01}));

}  // namespace
}  // namespace adit
