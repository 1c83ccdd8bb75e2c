#include "adit/survey/station_sight.hpp"

#include <gtest/gtest.h>

namespace adit {
namespace {

const ScannerModel kScanner{.range_sigma_m = 0.01, .quantisation_m = 0.0, .max_range_m = 50.0};

/// A full turn of beams that all end at one range.
LaserScan round_scan(double range, double from = -kPi, int beams = 720) {
  LaserScan scan;
  scan.first_bearing = from;
  scan.bearing_step = kTwoPi / 720.0;
  scan.max_range = 50.0;
  scan.ranges.assign(static_cast<std::size_t>(beams), range);
  return scan;
}

StationSight sight_of(std::span<const LaserScan> scans) {
  StationSight sight(Vector2d::Zero());
  for (const LaserScan& scan : scans) sight.add(scan, 0.0, kScanner);
  sight.finish();
  return sight;
}

double seen_through(const StationSight& sight, const StationPoint& point) {
  return sight.share_seen_through(std::span(&point, 1), {}, 0.5);
}

TEST(StationSight, SeesThroughWhatLiesBeforeTheEndsOfItsBeams) {
  const StationSight sight = sight_of(std::vector{round_scan(10.0)});
  EXPECT_EQ(seen_through(sight, {{9.0, 0.0}, {-1.0, 0.0}}), 1.0);
  EXPECT_EQ(seen_through(sight, {{9.0, 0.0}, {1.0, 0.0}}), 1.0);  // from behind as well
  EXPECT_EQ(seen_through(sight, {{9.8, 0.0}, {-1.0, 0.0}}), 0.0);
  EXPECT_EQ(seen_through(sight, {{12.0, 0.0}, {-1.0, 0.0}}), 0.0);
  EXPECT_EQ(seen_through(sight, {{9.0, 0.0}, {0.1, 1.0}}), 0.0);  // too flat to tell
}

TEST(StationSight, TakesTheMiddleOfTheScans) {
  const StationSight open =
      sight_of(std::vector{round_scan(10.0), round_scan(10.0), round_scan(3.0)});
  const StationSight shut =
      sight_of(std::vector{round_scan(3.0), round_scan(10.0), round_scan(3.0)});
  const StationPoint between{{6.0, 0.0}, {-1.0, 0.0}};
  EXPECT_EQ(seen_through(open, between), 1.0);
  EXPECT_EQ(seen_through(shut, between), 0.0);
}

TEST(StationSight, SaysNothingWhereNoBeamReturned) {
  const StationPoint left{{0.0, 5.0}, {0.0, -1.0}};
  EXPECT_EQ(seen_through(sight_of(std::vector{round_scan(50.0)}), left), 0.0);
  EXPECT_EQ(seen_through(sight_of(std::vector{round_scan(10.0, -kPi, 300)}), left), 0.0);
  EXPECT_EQ(seen_through(StationSight(), left), 0.0);
}

TEST(StationSight, LooksFromWhereTheScannerIsMounted) {
  LaserScan scan = round_scan(10.0);
  scan.vehicle_from_laser = {2.0, 0.0, 1.0};
  StationSight sight(scan.vehicle_from_laser.translation());
  sight.add(scan, 0.0, kScanner);
  sight.finish();
  const StationPoint ahead{{11.0, 0.0}, {-1.0, 0.0}};
  EXPECT_EQ(seen_through(sight, ahead), 1.0);
  EXPECT_EQ(sight.share_seen_through(std::span(&ahead, 1), {1.0, 0.0, 0.0}, 0.5), 0.0);
}

TEST(StationSight, KnowsThatAMachineThatTurnsCarriesItsScannerAbout) {
  LaserScan scan = round_scan(10.0);
  scan.vehicle_from_laser = {2.0, 0.0, 0.0};
  StationSight sight(scan.vehicle_from_laser.translation());
  sight.add(scan, kPi, kScanner);  // its eye was at -2, 0
  sight.finish();
  EXPECT_EQ(seen_through(sight, {{9.0, 0.0}, {-1.0, 0.0}}), 0.0);
  EXPECT_EQ(seen_through(sight, {{-11.0, 0.0}, {1.0, 0.0}}), 1.0);
}

}  // namespace
}  // namespace adit
