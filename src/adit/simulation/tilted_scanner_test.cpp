#include "adit/simulation/tilted_scanner.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "adit/simulation/world.hpp"

namespace adit {
namespace {

ScannerSpec exact() {
  ScannerSpec spec = sick();
  spec.model.range_sigma_m = 0.0;
  spec.model.quantisation_m = 0.0;
  return spec;
}

TEST(SimulateTiltedScan, IsThePlainScanWhenLevel) {
  const std::vector<Vector2d> corners{{-4.0, -3.0}, {5.0, -3.0}, {5.0, 6.0}, {-4.0, 6.0}};
  const RayCaster caster(outline(corners));
  Random a(1), b(1);
  const LaserScan plain = simulate_scan(caster, {0.5, 0.2, 0.3}, exact(), a);
  const LaserScan tilted = simulate_tilted_scan(caster, {0.5, 0.2, 0.3}, exact(), {}, {}, b);
  ASSERT_EQ(plain.ranges.size(), tilted.ranges.size());
  for (std::size_t i = 0; i < plain.ranges.size(); ++i) {
    EXPECT_NEAR(plain.ranges[i], tilted.ranges[i], 1e-9);
  }
}

TEST(SimulateTiltedScan, MeetsTheFloorAheadWhenTheNoseIsDown) {
  const RayCaster nothing(std::vector<Segment>{{{70.0, -1.0}, {70.0, 1.0}}});
  Random random(1);
  ScannerSpec spec = exact();
  spec.beams = 2;
  spec.first_bearing = 0.0;
  spec.bearing_step = kPi;
  const LaserScan scan = simulate_tilted_scan(nothing, {}, spec, {radians(3.0), 0.0},
                                              {.roof_above_m = 2.0, .floor_below_m = 1.0}, random);
  EXPECT_NEAR(scan.ranges[0], 1.0 / std::sin(radians(3.0)), 1e-9);
  EXPECT_NEAR(scan.ranges[1], 2.0 / std::sin(radians(3.0)), 1e-9);
}

TEST(TiltedDirection, IsAUnitVectorThatRollLiftsOnTheLeft) {
  const Vector3d left = tilted_direction(0.5 * kPi, {0.0, radians(5.0)});
  EXPECT_NEAR(left.norm(), 1.0, 1e-12);
  EXPECT_NEAR(left.z(), std::sin(radians(5.0)), 1e-12);
}

}  // namespace
}  // namespace adit
