#include "adit/extraction/noise_estimate.hpp"

#include <gtest/gtest.h>

#include <random>

namespace adit {
namespace {

/// A corridor 4 m wide around the scanner whose walls stray by `roughness` from straight, in pieces
/// of 0.2 m, with a box before one wall.
LaserScan corridor(double sigma, double roughness, unsigned seed) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  std::vector<double> offsets(400);
  for (double& offset : offsets) offset = roughness * normal(random);
  LaserScan scan;
  scan.bearing_step = kTwoPi / 1440;
  scan.max_range = 30.0;
  for (int i = 0; i < 1440; ++i) {
    const Vector2d beam = unit_vector(scan.bearing(static_cast<std::size_t>(i)));
    double range = 2.0 / std::max(1e-9, std::abs(beam.y()));
    const double along = range * beam.x();
    if (beam.y() > 0 && along > 1.0 && along < 2.0) range = 1.2 / beam.y();
    if (std::abs(along) < 38.0) {
      range += offsets[static_cast<std::size_t>((along + 40.0) / 0.2)] / std::abs(beam.y());
    }
    scan.ranges.push_back(range + sigma * normal(random));
  }
  return scan;
}

TEST(ScatterEstimate, FindsTheNoiseOfSmoothWalls) {
  for (const double sigma : {0.005, 0.02, 0.1}) {
    ScatterEstimator estimator;
    for (unsigned seed = 0; seed < 30; ++seed) estimator.add(corridor(sigma, 0.0, seed));
    const auto estimate = estimator.estimate();
    ASSERT_TRUE(estimate.has_value());
    EXPECT_NEAR(estimate->beam_sigma_m / sigma, 1.0, 0.2) << sigma;
    EXPECT_LT(estimate->roughness_m, 0.6 * sigma);
  }
}

TEST(ScatterEstimate, TellsRoughWallsFromANoisyScanner) {
  ScatterEstimator estimator;
  for (unsigned seed = 0; seed < 30; ++seed) estimator.add(corridor(0.01, 0.1, seed));
  const auto estimate = estimator.estimate();
  ASSERT_TRUE(estimate.has_value());
  EXPECT_LT(estimate->beam_sigma_m, 0.05);
  EXPECT_NEAR(estimate->roughness_m, 0.1, 0.05);
}

TEST(ScatterEstimate, NeedsSomethingToLearnFrom) {
  ScatterEstimator estimator;
  EXPECT_FALSE(estimator.estimate().has_value());
}

}  // namespace
}  // namespace adit
