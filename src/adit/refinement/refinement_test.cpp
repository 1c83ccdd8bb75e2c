#include "adit/refinement/refinement.hpp"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <vector>

#include "adit/information/beam.hpp"
#include "adit/refinement/pose_search.hpp"
#include "adit/simulation/random.hpp"
#include "support/fitting_scene.hpp"
#include "support/repeats.hpp"

namespace adit {
namespace {

using namespace testing;  // NOLINT(google-build-using-namespace): the scene

/// The pose that the scan alone makes most likely.
Pose2 best(const ScanFit& fit) {
  return Pose2::from_vector(fit.pose.vector() + fit.information.ldlt().solve(fit.score));
}

double metres_apart(const Pose2& a, const Pose2& b) {
  return (a.translation() - b.translation()).norm();
}

const MapError kPerfect{0.0, 1.5, 0.0};

/// How far a pose is from the fit's best, in the fit's own units: chi-square of three degrees of
/// freedom.
double chi_square_of(const ScanFit& fit, const Pose2& truth) {
  const Pose2 found = best(fit);
  const Vector3d error(found.x - truth.x, found.y - truth.y,
                       angle_between(truth.theta, found.theta));
  return error.dot(fit.information * error);
}

class Fitting {
 public:
  explicit Fitting(const std::vector<Segment>& plan, double range_sigma_m = 0.02)
      : map_(map_of(plan)), scanner_(scanner(range_sigma_m)) {}

  const ScanFit& fit(const LaserScan& scan, const Pose2& start, double metres, double radians) {
    const PoseWithCovariance prior = around(start, metres, radians);
    return fit(scan, prior, prior);
  }
  const ScanFit& fit(const LaserScan& scan, const PoseWithCovariance& prior,
                     const PoseWithCovariance& start) {
    RefinementOptions patient;
    patient.max_iterations = 20;
    return refiner_.refine({map_, scan, scanner_, kPerfect, {}}, prior, start, patient);
  }
  /// From a start that is off by so much in any direction, and turned by 5 degrees for 0.3 m.
  const ScanFit& fit_from(double metres, const LaserScan& scan, const Pose2& truth,
                          Random& random) {
    const Vector2d aside = metres * unit_vector(random.uniform(-kPi, kPi));
    const double turn = radians(5.0) * metres / 0.3;
    const double side = random.chance(0.5) ? 1.0 : -1.0;
    return fit(scan, moved_by(truth, aside.x(), aside.y(), side * turn), metres, turn);
  }

  const LineMap& map() const { return map_; }
  Refiner& refiner() { return refiner_; }

 private:
  LineMap map_;
  ScannerModel scanner_;
  Refiner refiner_;
};

constexpr double kFarBeyondChance = 100.0;  // chi-square of three degrees of freedom

constexpr int kTrials = test::repeats(300);

TEST(Refiner, FindsThePoseFromAfarWithThePapersScanner) {
  Random random(1);
  Fitting fitting(mockup_walls(), 0.1);
  Scene scene;
  scene.range_sigma_m = 0.1;
  int converged = 0;
  for (int trial = 0; trial < kTrials; ++trial) {
    const Pose2 truth = random_pose(scene.solid, random);
    const LaserScan scan = scan_from(truth, scene, random);
    const ScanFit& fit = fitting.fit_from(0.3, scan, truth, random);
    converged += fit.converged ? 1 : 0;
    EXPECT_LT(chi_square_of(fit, truth), kFarBeyondChance);
    EXPECT_LT(metres_apart(best(fit), truth), 0.15);
    EXPECT_GT(fit.counts.wall, 0.85 * 360);
    EXPECT_GT(fit.log_evidence, 0.7 * fit.expected_log_evidence);
  }
  EXPECT_GE(converged, kTrials - kTrials / 60);
}

TEST(Refiner, AFitInAnotherPlaceDoesNotLookLikeOne) {
  // A good scanner sees wrong walls as wrong, so that it must start nearer.
  Random random(1);
  Fitting fitting(mockup_walls());
  const Scene scene;
  int right = 0;
  for (int trial = 0; trial < kTrials; ++trial) {
    const Pose2 truth = random_pose(scene.solid, random);
    const LaserScan scan = scan_from(truth, scene, random);
    const ScanFit& fit = fitting.fit_from(0.3, scan, truth, random);
    const bool is_right = chi_square_of(fit, truth) < kFarBeyondChance;
    const bool looks_right = fit.converged && fit.log_evidence > 0.8 * fit.expected_log_evidence;
    EXPECT_TRUE(is_right || !looks_right);
    right += is_right ? 1 : 0;
    EXPECT_LT(chi_square_of(fitting.fit_from(0.1, scan, truth, random), truth), kFarBeyondChance);
  }
  EXPECT_GT(right, 0.8 * kTrials);
}

TEST(Refiner, IsExactWhereTheScannerIs) {
  Random random(2);
  Fitting fitting(mockup_walls());
  Scene scene;
  scene.range_sigma_m = 0.0;
  for (int trial = 0; trial < kTrials / 3; ++trial) {
    const Pose2 truth = random_pose(scene.solid, random);
    const ScanFit& fit = fitting.fit_from(0.1, scan_from(truth, scene, random), truth, random);
    EXPECT_LT(metres_apart(best(fit), truth), 1e-3);
    EXPECT_LT(std::abs(angle_between(best(fit).theta, truth.theta)), 1e-4);
  }
}

/// The worst of many fits (m), and how much of what the beams met was told from walls.
struct Worst {
  double metres = 0.0;
  double before = 0.0;
  double no_return = 0.0;
};

Worst worst_of_fits(const Scene& scene, std::uint64_t seed) {
  Random random(seed);
  Fitting fitting(mockup_walls());
  Worst worst;
  for (int trial = 0; trial < kTrials / 3; ++trial) {
    const Pose2 truth = random_pose(scene.solid, random);
    const ScanFit& fit = fitting.fit_from(0.05, scan_from(truth, scene, random), truth, random);
    worst.metres = std::max(worst.metres, metres_apart(best(fit), truth));
    worst.before += fit.counts.before / (120.0 * kTrials);
    worst.no_return += fit.counts.no_return / (120.0 * kTrials);
  }
  return worst;
}

TEST(Refiner, LooksPastBoxesThatThePlanDoesNotHave) {
  Scene scene;
  Random random(3);
  for (int box = 0; box < 12; ++box) {
    const Pose2 at = random_pose(mockup_walls(), random);
    add_outline(scene.solid, {at * Vector2d(0, 0), at * Vector2d(0.8, 0), at * Vector2d(0.8, 0.6),
                              at * Vector2d(0, 0.6)});
  }
  const Worst worst = worst_of_fits(scene, 4);
  EXPECT_LT(worst.metres, 0.02);
  EXPECT_GT(worst.before, 0.08);
}

TEST(Refiner, LooksThroughDust) {
  Scene scene;
  scene.dust_ratio = 0.1;
  const Worst worst = worst_of_fits(scene, 5);
  EXPECT_LT(worst.metres, 0.02);
  EXPECT_NEAR(worst.before, 0.09, 0.02);
}

TEST(Refiner, DoesWithoutBeamsThatBringNothing) {
  Scene scene;
  scene.dropout_ratio = 0.2;
  const Worst worst = worst_of_fits(scene, 6);
  EXPECT_LT(worst.metres, 0.02);
  EXPECT_NEAR(worst.no_return, 0.2, 0.02);
}

TEST(Refiner, SeesNothingAlongAStraightDrift) {
  const double heading = 0.7;
  const Pose2 drift{3.0, 4.0, heading};
  Scene scene;
  scene.solid = {{drift * Vector2d(-200.0, 2.5), drift * Vector2d(200.0, 2.5)},
                 {drift * Vector2d(-200.0, -2.5), drift * Vector2d(200.0, -2.5)}};
  Fitting fitting(scene.solid);
  Random random(7);
  const Pose2 truth = drift * Pose2{5.0, 0.4, 0.2};
  const LaserScan scan = scan_from(truth, scene, random);
  const Vector3d along(std::cos(heading), std::sin(heading), 0.0);
  // The start lies half a metre farther on than the prior has it.
  const Pose2 guess = moved_by(truth, 0.1, -0.1, 0.03);
  const Pose2 farther = Pose2::from_vector(guess.vector() + 0.5 * along);
  const ScanFit& fit = fitting.fit(scan, around(guess, 0.2, 0.05), around(farther, 0.2, 0.05));
  EXPECT_TRUE(fit.converged);
  const Vector3d across(-std::sin(heading), std::cos(heading), 0.0);
  const double seen = across.dot(fit.information * across);
  EXPECT_GT(seen, 1e4);
  EXPECT_LT(std::abs(along.dot(fit.information * along)), 1e-9 * seen);
  EXPECT_LT(std::abs(along.dot(fit.score)), 1e-6 * std::sqrt(seen));
  // Across it is found; along it is where the prior has it.
  const Vector3d off = fit.pose.vector() - truth.vector();
  EXPECT_NEAR(across.dot(off), 0.0, 0.01);
  EXPECT_NEAR(along.dot(off), along.dot(guess.vector() - truth.vector()), 0.01);
  EXPECT_NEAR(off.z(), 0.0, 0.003);
}

TEST(Refiner, TheWallsAddUpToTheFit) {
  Random random(8);
  Fitting fitting(mockup_walls());
  const Scene scene;
  const Pose2 truth = random_pose(scene.solid, random);
  const LaserScan scan = scan_from(truth, scene, random);
  const ScanFit& fit = fitting.fit_from(0.1, scan, truth, random);
  NormalEquations<3> sum;
  std::vector<int> walls;
  for (const WallShare& share : fitting.refiner().shares()) {
    sum += share.equations;
    walls.push_back(share.wall);
    EXPECT_EQ(share.equations.information, share.equations.information.transpose());
  }
  std::sort(walls.begin(), walls.end());
  EXPECT_EQ(std::adjacent_find(walls.begin(), walls.end()), walls.end());
  EXPECT_LT((sum.information - fit.information).norm(), 1e-9 * fit.information.norm());
  EXPECT_LT((sum.score - fit.score).norm(), 1e-9 * (1.0 + fit.score.norm()));
  EXPECT_NEAR(sum.chi_square, fit.chi_square, 1e-9 * fit.chi_square);
  EXPECT_EQ(fit.information, fit.information.transpose());
  EXPECT_EQ(fit.white_information, fit.white_information.transpose());
}

TEST(Refiner, EachBeamCountsByItsNoiseAndTheProbabilityOfItsWall) {
  Random random(12);
  Fitting fitting(mockup_walls());
  Scene scene;
  scene.dust_ratio = 0.3;
  const Pose2 truth = random_pose(scene.solid, random);
  const ScanFit& fit = fitting.fit_from(0.05, scan_from(truth, scene, random), truth, random);
  const ScannerModel model = scanner();
  Matrix3d sum = Matrix3d::Zero();
  int uncertain = 0;
  for (std::size_t k = 0; k < fitting.refiner().beams().size(); ++k) {
    const BeamResidual& beam = fitting.refiner().beams()[k];
    const double probability = fitting.refiner().on_wall()[k];
    uncertain += probability > 0.02 && probability < 0.98 ? 1 : 0;
    sum += probability * beam.gradient * beam.gradient.transpose() /
           beam_variance(model, beam.range, 1.0 / beam.stretch, 0.0);
  }
  EXPECT_GT(uncertain, 20);
  EXPECT_LT((fit.white_information - sum).norm(), 1e-3 * sum.norm());
}

TEST(Refiner, GivesTheSameBitsWhateverItDidBefore) {
  Random random(9);
  Fitting used(mockup_walls());
  const Scene scene;
  for (int trial = 0; trial < test::repeats(20); ++trial) {
    const Pose2 truth = random_pose(scene.solid, random);
    const LaserScan scan = scan_from(truth, scene, random);
    const Pose2 start = moved_by(truth, 0.1, -0.2, 0.05);
    Fitting fresh(mockup_walls());
    const ScanFit& one = fresh.fit(scan, start, 0.3, 0.1);
    const ScanFit& other = used.fit(scan, start, 0.3, 0.1);
    EXPECT_EQ(one.pose.vector(), other.pose.vector());
    EXPECT_EQ(one.information, other.information);
    EXPECT_EQ(one.score, other.score);
    EXPECT_EQ(one.log_evidence, other.log_evidence);
  }
}

TEST(Refiner, FindsTheMostLikelyOfALattice) {
  Random random(10);
  Fitting fitting(mockup_walls());
  const Scene scene;
  const ScannerModel model = scanner();
  int nearest = 0;
  for (int trial = 0; trial < kTrials / 6; ++trial) {
    const Pose2 truth = random_pose(scene.solid, random);
    const LaserScan scan = scan_from(truth, scene, random);
    const double left = random.uniform(-0.5, 0.5);
    const double ahead = random.uniform(-0.5, 0.5);
    const PoseWithCovariance prior = around(moved_by(truth, ahead, left, 0.05), 0.4, 0.1);
    const PoseLattice lattice(prior, {});
    const Pose2 found = fitting.refiner().most_likely({fitting.map(), scan, model, kPerfect, {}},
                                                      prior, lattice.poses(), lattice.spread(), {});
    const Matrix3d inverse_spread = lattice.spread().inverse();
    const Vector3d off(found.x - truth.x, found.y - truth.y,
                       angle_between(truth.theta, found.theta));
    nearest += off.dot(inverse_spread * off) < 4.0 ? 1 : 0;
  }
  EXPECT_GE(nearest, 0.9 * (kTrials / 6));
}

TEST(Refiner, LearnsNothingFromAScanWithoutReturns) {
  Random random(11);
  Fitting fitting(mockup_walls());
  LaserScan scan = scan_from({3.5, 8.0, 0.3}, {}, random);
  std::fill(scan.ranges.begin(), scan.ranges.end(), scan.max_range);
  const ScanFit& fit = fitting.fit(scan, {3.5, 8.0, 0.3}, 0.3, 0.1);
  EXPECT_EQ(fit.information, Matrix3d::Zero());
  EXPECT_EQ(fit.score, Vector3d::Zero());
  EXPECT_EQ(fit.counts.returns(), 0.0);
  EXPECT_EQ(fit.pose.vector(), Vector3d(3.5, 8.0, 0.3));
  EXPECT_TRUE(fitting.refiner().shares().empty());
}

}  // namespace
}  // namespace adit
