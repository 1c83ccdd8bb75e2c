#include "adit/relocation/corner_search.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "adit/visibility/visibility.hpp"

namespace adit {
namespace {

/// A gallery of rooms of different size, as wide as a plan whose index has no places.
LineMap rooms() {
  std::vector<Segment> walls;
  for (int i = 0; i < 12; ++i) {
    const double x = 1000.0 + 40.0 * i;
    const double width = 8.0 + 1.7 * i;
    const std::vector<Vector2d> corners{{x, 0.0},       {x + width, 0.0}, {x + width, 9.0},
                                        {x + 5.0, 9.0}, {x + 5.0, 13.0},  {x, 13.0}};
    for (std::size_t k = 0; k < corners.size(); ++k) {
      walls.push_back({corners[k], corners[(k + 1) % corners.size()]});
    }
  }
  return LineMap::build(walls);
}

ScannerModel scanner() {
  return {.range_sigma_m = 0.02, .quantisation_m = 0.01, .max_range_m = 40.0, .min_range_m = 0.1};
}

LaserScan scan_from(const LineMap& map, const Pose2& laser) {
  LaserScan scan;
  scan.first_bearing = -kPi;
  scan.bearing_step = radians(0.5);
  scan.max_range = scanner().max_range_m;
  scan.ranges.resize(720);
  Visibility visibility;
  visibility.sweep(map, laser.translation(), scan.max_range);
  visibility.ranges(laser.theta - kPi, scan.bearing_step, scan.ranges);
  return scan;
}

/// An index without places: corners are all there is.
PlaceIndex corners_alone(const LineMap& map) { return {map, PlaceArrays{}}; }

TEST(CornerSearch, TakesCornersOfTheScanForThoseOfThePlan) {
  const LineMap map = rooms();
  const PlaceIndex index = corners_alone(map);
  const Pose2 truth{1203.0, 4.0, 2.1};
  CornerSearch search;
  const auto found = search.find(index, scan_from(map, truth), scanner(), {}, 100, {});
  ASSERT_FALSE(found.empty());
  double nearest = 1e9;
  for (const PlaceMatch& match : found) {
    const Vector3d off = difference(truth, match.map_from_laser);
    if (std::abs(off.z()) < radians(1.0)) nearest = std::min(nearest, off.head<2>().norm());
  }
  EXPECT_LT(nearest, 0.1);
  EXPECT_LE(found.size(), 100u);
}

TEST(CornerSearch, RatesAgainOnlyTheBestAndFindsTheCornerAmongThem) {
  const LineMap map = rooms();
  const PlaceIndex index = corners_alone(map);
  const Pose2 truth{1203.0, 4.0, 2.1};
  CornerSearchOptions few;
  few.rated_share = 0.0;
  few.fewest_rated = 20;
  CornerSearch search;
  const LaserScan scan = scan_from(map, truth);
  const std::size_t all = search.find(index, scan, scanner(), {}, 1000, {}).size();
  const auto found = search.find(index, scan, scanner(), {}, 1000, few);
  EXPECT_LT(found.size(), all);
  EXPECT_TRUE(std::any_of(found.begin(), found.end(), [&](const PlaceMatch& match) {
    const Vector3d off = difference(truth, match.map_from_laser);
    return off.head<2>().norm() < 0.1 && std::abs(off.z()) < radians(1.0);
  }));
}

TEST(CornerSearch, TakesMoreOfTheLastSearchWithoutRatingItAgain) {
  const LineMap map = rooms();
  const PlaceIndex index = corners_alone(map);
  const LaserScan scan = scan_from(map, {1203.0, 4.0, 2.1});
  CornerSearch search;
  const std::size_t few = search.find(index, scan, scanner(), {}, 5, {}).size();
  EXPECT_LE(few, 5u);
  const auto more = search.take(index, 100);
  EXPECT_GT(more.size(), few);
  CornerSearch at_once;
  const auto same = at_once.find(index, scan, scanner(), {}, 100, {});
  ASSERT_EQ(more.size(), same.size());
  for (std::size_t i = 0; i < more.size(); ++i) {
    EXPECT_EQ(more[i].map_from_laser.x, same[i].map_from_laser.x);
    EXPECT_EQ(more[i].map_from_laser.theta, same[i].map_from_laser.theta);
  }
}

TEST(CornerSearch, LooksOnlyWhereItIsAskedTo) {
  const LineMap map = rooms();
  const PlaceIndex index = corners_alone(map);
  const LaserScan scan = scan_from(map, {1203.0, 4.0, 2.1});
  const SearchArea area{{1403.0, 4.0}, 30.0};
  CornerSearch search;
  const auto found = search.find(index, scan, scanner(), area, 100, {});
  EXPECT_FALSE(found.empty());
  for (const PlaceMatch& match : found) {
    EXPECT_TRUE(area.holds(match.map_from_laser.translation()));
  }
}

TEST(CornerSearch, FindsNothingWithoutCorners) {
  const LineMap map = rooms();
  LaserScan scan = scan_from(map, {1203.0, 4.0, 2.1});
  scan.ranges.assign(scan.ranges.size(), scan.max_range);
  CornerSearch search;
  EXPECT_TRUE(search.find(corners_alone(map), scan, scanner(), {}, 100, {}).empty());
}

}  // namespace
}  // namespace adit
