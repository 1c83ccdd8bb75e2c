#include "adit/refinement/pose_search.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "adit/simulation/random.hpp"
#include "support/draws.hpp"

namespace adit {
namespace {

PoseWithCovariance around(const Pose2& pose, double sigma_x, double sigma_y, double sigma_rad) {
  return {pose, Vector3d(sigma_x, sigma_y, sigma_rad).cwiseAbs2().asDiagonal()};
}

/// How far the lattice reaches on each side (m, m, rad).
Vector3d reach_of(const PoseLattice& lattice, const Pose2& centre) {
  Vector3d reach = Vector3d::Zero();
  for (const Pose2& pose : lattice.poses()) {
    reach = reach.cwiseMax(difference(centre, pose).cwiseAbs());
  }
  return reach;
}

const Pose2 kCentre{3.0, -7.0, 3.1};

TEST(PoseLattice, HoldsThePredictionAndIsSymmetric) {
  const PoseLattice lattice(around(kCentre, 0.4, 0.1, 0.2), {});
  const auto has = [&](const Vector3d& from_centre) {
    return std::any_of(lattice.poses().begin(), lattice.poses().end(), [&](const Pose2& pose) {
      return (difference(kCentre, pose) - from_centre).norm() < 1e-12;
    });
  };
  EXPECT_TRUE(has(Vector3d::Zero()));
  for (const Pose2& pose : lattice.poses()) {
    const Vector3d there = difference(kCentre, pose);
    EXPECT_TRUE(has(-there));
    EXPECT_TRUE(has({there.y(), there.x(), there.z()}));
    EXPECT_TRUE(has({there.x(), there.y(), -there.z()}));
    EXPECT_LE(std::abs(pose.theta), kPi);
  }
}

TEST(PoseLattice, CoversAllThatIsWithinReach) {
  Random random(1);
  for (const PoseWithCovariance& prediction :
       {around(kCentre, 0.4, 0.1, 0.2), around(kCentre, 0.001, 0.001, 1e-4)}) {
    const PoseLattice lattice(prediction, {});
    const Vector3d half = lattice.spread().diagonal().cwiseSqrt();
    const Vector3d reach = reach_of(lattice, kCentre) + half;
    for (int i = 0; i < 2000; ++i) {
      const Vector3d inside = test::drawn<3>([&] { return random.uniform(-1, 1); });
      const Vector3d at = reach.cwiseProduct(inside);
      const bool covered =
          std::any_of(lattice.poses().begin(), lattice.poses().end(), [&](const Pose2& pose) {
            const Vector3d off = (difference(kCentre, pose) - at).cwiseAbs();
            return (off.array() <= half.array() * (1.0 + 1e-9)).all();
          });
      ASSERT_TRUE(covered) << at.transpose();
    }
  }
}

TEST(PoseLattice, ReachesAsFarAsAsked) {
  const SearchOptions options;
  const Vector3d wide = reach_of(PoseLattice(around(kCentre, 0.3, 0.4, 0.2), options), kCentre);
  EXPECT_NEAR(wide.x(), options.reach_sigmas * 0.5, 1e-12);
  EXPECT_NEAR(wide.y(), options.reach_sigmas * 0.5, 1e-12);
  EXPECT_NEAR(wide.z(), options.reach_sigmas * 0.2, 1e-12);
  const Vector3d least = reach_of(PoseLattice(around(kCentre, 1e-3, 1e-3, 1e-3), options), kCentre);
  EXPECT_NEAR(least.x(), options.least_reach_m, 1e-12);
  EXPECT_NEAR(least.z(), options.least_reach_rad, 1e-12);
}

}  // namespace
}  // namespace adit
