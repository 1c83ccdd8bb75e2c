#include "adit/relocation/view_search.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "adit/visibility/visibility.hpp"

namespace adit {
namespace {

constexpr std::size_t kBeams = 360;

ScannerModel scanner() { return {.max_range_m = 40.0, .min_range_m = 0.1}; }

/// Pillars eighteen metres apart, each of other sides.
LineMap panel() {
  constexpr int kSide = 8;
  std::vector<Segment> walls;
  for (int row = 0; row < kSide; ++row) {
    for (int column = 0; column < kSide; ++column) {
      const int number = kSide * row + column;
      const double left = 18.0 * column + 0.7 * (number % 5);
      const double right = 18.0 * column + 11.0 + 0.6 * (number % 7);
      const double low = 18.0 * row + 0.9 * (number % 4);
      const double high = 18.0 * row + 11.0 + 0.5 * (number % 6);
      const Vector2d a(left, low), b(right, low), c(right, high), d(left, high);
      for (const Segment& side : {Segment{a, b}, Segment{b, c}, Segment{c, d}, Segment{d, a}}) {
        walls.push_back(side);
      }
    }
  }
  return LineMap::build(walls);
}

LaserScan scan_from(const LineMap& map, const Pose2& laser) {
  LaserScan scan;
  scan.first_bearing = -kPi;
  scan.bearing_step = kTwoPi / static_cast<double>(kBeams);
  scan.max_range = scanner().max_range_m;
  scan.ranges.resize(kBeams);
  Visibility visibility;
  visibility.sweep(map, laser.translation(), scan.max_range);
  visibility.ranges(laser.theta + scan.first_bearing, scan.bearing_step, scan.ranges);
  return scan;
}

/// A gate that lets so few places through that a misjudged one is gone.
RelocationOptions narrow_gate() {
  RelocationOptions options;
  options.rated_share = 0.02;
  options.fewest_rated = 1;
  return options;
}

bool finds(const PlaceIndex& index, const LaserScan& scan, const Pose2& truth) {
  ViewSearch search;
  const auto found = search.find(index, scan, scanner(), {}, narrow_gate());
  return std::any_of(found.begin(), found.end(), [&](const PlaceMatch& match) {
    const Vector3d off = difference(truth, match.map_from_laser);
    return off.head<2>().norm() < 1.0 && std::abs(off.z()) < radians(8.0);
  });
}

std::vector<Pose2> crossings() {
  std::vector<Pose2> poses;
  for (int i = 0; i < 12; ++i) {
    poses.push_back({33.5 + 18.0 * (i % 4), 33.8 + 18.0 * (i / 4), 0.5 * i});
  }
  return poses;
}

TEST(ViewSearch, FindsAPlaceAmongThousands) {
  const LineMap map = panel();
  const PlaceIndex index = PlaceIndex::build(map);
  ASSERT_GT(index.size(), 5000U);
  for (const Pose2& truth : crossings()) EXPECT_TRUE(finds(index, scan_from(map, truth), truth));
}

TEST(ViewSearch, FindsAPlaceOfWhichAQuarterIsHidden) {
  const LineMap map = panel();
  const PlaceIndex index = PlaceIndex::build(map);
  for (const Pose2& truth : crossings()) {
    LaserScan scan = scan_from(map, truth);
    // Three machines close by, each across thirty degrees.
    for (const std::size_t first : {20U, 150U, 270U}) {
      for (std::size_t i = first; i < first + 30; ++i) {
        scan.ranges[i] = std::min(scan.ranges[i], 1.6);
      }
    }
    EXPECT_TRUE(finds(index, scan, truth)) << truth.x << ' ' << truth.y;
  }
}

TEST(ViewSearch, FindsNothingForAScanWithoutBeams) {
  const LineMap map = panel();
  const PlaceIndex index = PlaceIndex::build(map);
  LaserScan scan;
  ViewSearch search;
  EXPECT_TRUE(search.find(index, scan, scanner(), {}, {}).empty());
}

}  // namespace
}  // namespace adit
