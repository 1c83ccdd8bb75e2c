#include <gtest/gtest.h>

#include <Eigen/LU>
#include <algorithm>
#include <utility>
#include <vector>

#include "adit/refinement/refinement.hpp"
#include "support/fitting_scene.hpp"

namespace adit {
namespace {

using namespace testing;  // NOLINT(google-build-using-namespace): the scene

/// A fit whose last step is taken as linear agrees with one that looks at the map again.
TEST(Refiner, TheLastStepLeadsToWhereTheMapIsLookedAtAgain) {
  Random random(21);
  double longest = 0.0;
  std::vector<double> unlikelier;
  for (int i = 0; i < 20; ++i) {
    const Scene scene;
    const Pose2 truth = random_pose(scene.solid, random);
    const LaserScan scan = scan_from(truth, scene, random);
    const LineMap map = map_of(scene.solid);
    const ScannerModel model = scanner();
    const MapError exact{0.001, 1.0, 0.001};
    const RefinementInput input{map, scan, model, exact, std::nullopt};
    const PoseWithCovariance prior = around(moved_by(truth, 0.03, -0.02, 0.01), 0.1, 0.03);
    const RefinementOptions once;
    RefinementOptions again;
    again.step_tolerance = 0.01;
    Refiner quick;
    Refiner thorough;
    const ScanFit& a = quick.refine(input, prior, prior, once);
    const ScanFit& b = thorough.refine(input, prior, prior, again);
    ASSERT_TRUE(a.converged && b.converged);
    longest = std::max(longest, static_cast<double>(b.iterations - a.iterations));
    const Vector3d off = difference(b.pose, a.pose);
    EXPECT_LT(off.dot(b.information * off), 0.25);  // half a sigma
    // But for a beam or two at an edge.
    EXPECT_NEAR(a.log_likelihood, b.log_likelihood, 8.0);
    EXPECT_NEAR(a.chi_square, b.chi_square, 6.0);
    unlikelier.push_back(b.log_likelihood - a.log_likelihood);
    // What is left of the score is the prior's pull.
    const Vector3d pull = prior.covariance.inverse() * difference(a.pose, prior.pose);
    EXPECT_LT((a.score + pull).norm(), 1e-6 * (1.0 + pull.norm()));
    BeamResiduals fresh;
    fresh.set_scan(scan, model);
    fresh.compute(map, a.pose, SweepPath{}, SweepCorrection{}, once);
    int compared = 0;
    for (const BeamResidual& beam : quick.beams()) {
      for (const BeamResidual& other : std::as_const(fresh).beams()) {
        if (other.beam != beam.beam || other.wall != beam.wall) continue;
        compared += std::abs(other.residual - beam.residual) < 0.002 ? 1 : 0;
      }
    }
    EXPECT_GT(compared, static_cast<int>(quick.beams().size()) - 6);
  }
  EXPECT_GT(longest, 0.5);  // some looked once less
  std::sort(unlikelier.begin(), unlikelier.end());
  EXPECT_NEAR(unlikelier[unlikelier.size() / 2], 0.0, 1.0);
}

}  // namespace
}  // namespace adit
