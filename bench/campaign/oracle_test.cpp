#include "oracle.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "adit/information/bound.hpp"
#include "adit/simulation/world.hpp"
#include "beam_bound.hpp"

namespace adit {
namespace {

ScannerSpec short_scanner() {
  ScannerSpec spec = hokuyo();  // 30 m
  spec.beams = 182;
  spec.bearing_step = 4.0 * spec.bearing_step;
  return spec;
}

/// A drift along x of 400 m, bare but for a crosscut at 300 m.
std::vector<Segment> drift() {
  const std::vector<Vector2d> corners{{0.0, 0.0},    {400.0, 0.0},  {400.0, 5.0}, {304.0, 5.0},
                                      {304.0, 20.0}, {300.0, 20.0}, {300.0, 5.0}, {0.0, 5.0}};
  return outline(corners);
}

class InADrift : public testing::Test {
 protected:
  double lead(const Pose2& truth, const Pose2& believed, std::uint64_t seed = 1) {
    Random random(seed);
    const LaserScan scan = simulate_scan(mine_, truth, spec_, random);
    return ScanOracle(mine_, spec_).lead_of_truth(scan, truth, believed);
  }

  RayCaster mine_{drift()};
  ScannerSpec spec_ = short_scanner();
};

TEST_F(InADrift, CannotTellOnePlaceOfABareDriftFromAnother) {
  double sum = 0.0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    sum += lead({100.0, 2.4, 0.1}, {103.0, 2.4, 0.1}, seed);
  }
  EXPECT_LT(std::abs(sum), kTellingLead);
}

TEST_F(InADrift, IsNotMisledByCentimetresAcross) {
  EXPECT_LT(std::abs(lead({100.0, 2.4, 0.0}, {103.0, 2.5, 0.005})), kTellingLead);
}

TEST_F(InADrift, TellsPlacesAtACrossing) {
  EXPECT_GT(lead({302.0, 2.4, 0.0}, {305.0, 2.4, 0.0}), 10.0 * kTellingLead);
  EXPECT_GT(lead({305.0, 2.4, 0.0}, {302.0, 2.4, 0.0}), 10.0 * kTellingLead);
}

TEST_F(InADrift, TellsAHeadingThatIsWrong) {
  EXPECT_GT(lead({100.0, 2.4, 0.0}, {100.0, 2.4, radians(8.0)}), 10.0 * kTellingLead);
}

TEST_F(InADrift, TakesNearPosesForOnePlace) {
  EXPECT_EQ(lead({302.0, 2.4, 0.0}, {302.3, 2.5, radians(2.0)}), 0.0);
}

TEST_F(InADrift, HoldsNothingAgainstAPlaceThatClutterHides) {
  Random random(3);
  const Pose2 truth{100.0, 2.4, 0.0};
  const std::vector<Segment> box =
      outline(std::vector<Vector2d>{{103.0, 1.0}, {104.0, 1.0}, {104.0, 2.0}, {103.0, 2.0}});
  const LaserScan scan = simulate_scan(mine_, truth, spec_, random, box);
  EXPECT_LT(std::abs(ScanOracle(mine_, spec_).lead_of_truth(scan, truth, {104.0, 2.4, 0.0})),
            kTellingLead);
}

// A beam over a wall straight ahead: the densities of the classes by hand.
TEST(ScanOracle, WeighsABeamByHand) {
  ScannerSpec spec;
  spec.beams = 1;
  spec.first_bearing = 0.0;
  spec.model = {.range_sigma_m = 0.1,
                .quantisation_m = 0.0,
                .bearing_sigma_rad = 0.0,
                .max_range_m = 50.0,
                .min_range_m = 0.1};
  const std::vector<Segment> wall{{{10.0, -5.0}, {10.0, 5.0}}};
  const RayCaster mine(wall);
  const ScanOracle oracle(mine, spec);
  LaserScan scan;
  scan.max_range = 50.0;
  scan.bearing_step = 1.0;
  const auto at = [&](double range) {
    scan.ranges = {range};
    return oracle.log_likelihood(scan, {});
  };
  const double peak = 0.899 / (0.1 * std::sqrt(kTwoPi));
  EXPECT_NEAR(at(10.1), std::log(peak * std::exp(-0.5) + 1e-3 / 50.0), 1e-9);
  EXPECT_NEAR(at(4.0), std::log(0.1 / 10.0 + 1e-3 / 50.0), 1e-9);
  EXPECT_NEAR(at(20.0), std::log(1e-3 / 50.0), 1e-9);
  EXPECT_NEAR(at(50.0), std::log(1e-3), 1e-9);
}

// In a square room the information of a beam on the middle of each wall can be summed by hand:
// positions 2 / variance on each axis; what clutter hides is not in it.
TEST(WallBeamBound, CountsOnlyBeamsOnWalls) {
  ScannerSpec spec;
  spec.beams = 360;
  spec.bearing_step = kTwoPi / 360;
  spec.model = {.range_sigma_m = 0.02,
                .quantisation_m = 0.0,
                .bearing_sigma_rad = 0.0,
                .max_range_m = 50.0,
                .min_range_m = 0.1};
  const std::vector<Segment> room =
      outline(std::vector<Vector2d>{{-5.0, -4.0}, {5.0, -4.0}, {5.0, 4.0}, {-5.0, 4.0}});
  const LineMap map = LineMap::build(room);
  const RayCaster walls(room);
  Random random(1);
  const LaserScan scan = simulate_scan(walls, {}, spec, random);
  WallBeamBound bound(map, spec);
  const auto open = bound.position_variance(scan, {}, {});
  BoundWorkspace workspace;
  BeamFan fan;
  fan.count = 360;
  fan.bearing_step = kTwoPi / 360;
  const PoseBound whole = cramer_rao(map, {}, spec.model, fan, {}, workspace);
  ASSERT_TRUE(open && whole.covariance);
  EXPECT_NEAR(*open, (whole.covariance->topLeftCorner<2, 2>().trace()), 1e-3 * *open);
  const std::vector<Segment> box =
      outline(std::vector<Vector2d>{{1.0, -1.0}, {2.0, -1.0}, {2.0, 1.0}, {1.0, 1.0}});
  Random again(1);
  const LaserScan hidden = simulate_scan(walls, {}, spec, again, box);
  const auto less = bound.position_variance(hidden, {}, box);
  ASSERT_TRUE(less);
  EXPECT_GT(*less, 1.05 * *open);
}

}  // namespace
}  // namespace adit
