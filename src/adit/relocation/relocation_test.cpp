#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <limits>
#include <vector>

#include "adit/relocation/relocator.hpp"
#include "adit/visibility/visibility.hpp"

namespace adit {
namespace {

void add_box(double x0, double y0, double x1, double y1, std::vector<Segment>& plan) {
  const Vector2d a(x0, y0), b(x1, y0), c(x1, y1), d(x0, y1);
  for (const Segment& side : {Segment{a, b}, Segment{b, c}, Segment{c, d}, Segment{d, a}}) {
    plan.push_back(side);
  }
}

/// Five entries and crosscuts around four pillars no two of which are alike.
std::vector<Segment> irregular_plan() {
  std::vector<Segment> plan;
  add_box(0.0, 0.0, 44.0, 36.0, plan);
  add_box(5.0, 6.0, 18.0, 15.0, plan);
  add_box(23.5, 4.5, 39.0, 16.0, plan);
  add_box(6.5, 20.0, 16.0, 31.0, plan);
  add_box(22.0, 22.0, 37.0, 30.0, plan);
  return plan;
}

/// Pillars that are all alike, twenty metres apart, without an outline.
std::vector<Segment> regular_plan(int side) {
  std::vector<Segment> plan;
  for (int row = 0; row < side; ++row) {
    for (int column = 0; column < side; ++column) {
      const double x = 20.0 * column;
      const double y = 20.0 * row;
      add_box(x, y, x + 14.0, y + 14.0, plan);
    }
  }
  return plan;
}

ScannerModel scanner() {
  return {.range_sigma_m = 0.02, .quantisation_m = 0.01, .max_range_m = 40.0, .min_range_m = 0.1};
}

/// What a scanner without noise measures.
LaserScan scan_from(const LineMap& map, const Pose2& map_from_vehicle,
                    const Pose2& vehicle_from_laser = {}, int beams = 360) {
  LaserScan scan;
  scan.first_bearing = -kPi;
  scan.bearing_step = kTwoPi / beams;
  scan.max_range = scanner().max_range_m;
  scan.vehicle_from_laser = vehicle_from_laser;
  scan.ranges.resize(static_cast<std::size_t>(beams));
  const Pose2 laser = map_from_vehicle * vehicle_from_laser;
  Visibility visibility;
  visibility.sweep(map, laser.translation(), scan.max_range);
  visibility.ranges(laser.theta + scan.first_bearing, scan.bearing_step, scan.ranges);
  return scan;
}

/// Something a metre across, two metres off, in so many beams from the first one on.
void add_clutter(LaserScan& scan, std::size_t first, std::size_t count) {
  for (std::size_t i = first; i < first + count; ++i)
    scan.ranges[i] = std::min(2.0, scan.ranges[i]);
}

MapError map_error() { return {0.05, 1.5, 0.01}; }

bool is_at(const Pose2& pose, const Pose2& truth, double metres, double radians) {
  const Vector3d off = difference(truth, pose);
  return off.head<2>().norm() < metres && std::abs(off.z()) < radians;
}

RelocationResult locate(const LineMap& map, const PlaceIndex& index, const LaserScan& scan,
                        std::optional<SearchArea> within = {}) {
  Relocator relocator(map, index);
  const ScannerModel model = scanner();
  const MapError error = map_error();
  return relocator.locate({scan, model, error, {}, within});
}

TEST(RangeCode, GrowsWithTheRangeAndEndsAtNothing) {
  EXPECT_EQ(range_code(0.0), 0);
  std::uint8_t last = 0;
  for (double range = 1.0; range < 100.0; range *= 1.2) {
    EXPECT_GT(range_code(range), last) << range;
    last = range_code(range);
  }
  EXPECT_EQ(range_code(1000.0), kNothingInSight);
  EXPECT_EQ(range_code(std::numeric_limits<double>::infinity()), kNothingInSight);
}

TEST(RangeCode, ScanOfHalfACircleLeavesTheOtherHalfUnseen) {
  LaserScan scan;
  scan.first_bearing = -0.5 * kPi;
  scan.bearing_step = kPi / 180.0;
  scan.max_range = 40.0;
  scan.ranges.assign(180, 5.0);
  const ScanCodes codes = code_scan(scan, scanner());
  EXPECT_EQ(codes.bins_seen, kRangeBins / 2);
  EXPECT_FALSE(codes.seen[0]);
  EXPECT_TRUE(codes.seen[kRangeBins / 2]);
  EXPECT_EQ(codes.codes[kRangeBins / 2], range_code(5.0));
}

TEST(RangeCode, BeamsWithoutReturnAreFar) {
  LaserScan scan;
  scan.first_bearing = -kPi;
  scan.bearing_step = kTwoPi / 360.0;
  scan.max_range = 40.0;
  scan.ranges.assign(360, std::numeric_limits<double>::quiet_NaN());
  const ScanCodes codes = code_scan(scan, scanner());
  EXPECT_EQ(codes.codes[7], range_code(40.0));
  EXPECT_EQ(codes.farthest, range_code(40.0));
}

TEST(RangeCode, BandHoldsTheRangesOfItsBin) {
  std::vector<double> ranges(kRangeBins * 4, 10.0);
  ranges[4 * 9 + 1] = 3.0;
  ranges[4 * 9 + 2] = 30.0;
  const RangeBands bands = code_ranges(ranges, 0);
  EXPECT_EQ(bands.nearest[9], range_code(3.0));
  EXPECT_EQ(bands.farthest[9], range_code(30.0));
  EXPECT_EQ(bands.nearest[10], range_code(10.0));
  EXPECT_EQ(code_ranges(ranges, 1).nearest[8], range_code(10.0));
  EXPECT_EQ(code_ranges(ranges, 2).nearest[8], range_code(3.0));
  EXPECT_EQ(code_ranges(ranges, 2).farthest[10], range_code(30.0));
}

TEST(PlaceIndex, HasNoPlacesInOrNearWalls) {
  const LineMap map = LineMap::build(irregular_plan());
  const PlaceIndexOptions options;
  const PlaceIndex index = PlaceIndex::build(map, options);
  ASSERT_GT(index.size(), 500u);
  for (std::size_t i = 0; i < index.size(); ++i) {
    std::vector<int> near;
    map.near(index.position(i), options.least_clearance_m, near);
    EXPECT_TRUE(near.empty()) << index.position(i).transpose();
  }
}

TEST(PlaceIndex, IsTheSameWithAnyNumberOfThreads) {
  const LineMap map = LineMap::build(irregular_plan());
  const PlaceIndex one = PlaceIndex::build(map, {}, 1);
  const PlaceIndex three = PlaceIndex::build(map, {}, 3);
  ASSERT_EQ(one.size(), three.size());
  for (std::size_t i = 0; i < one.size(); ++i) {
    EXPECT_EQ(one.position(i), three.position(i));
    EXPECT_EQ(one.codes(i).nearest, three.codes(i).nearest);
    EXPECT_EQ(one.codes(i).farthest, three.codes(i).farthest);
  }
}

TEST(PlaceIndex, HoldsNoMorePlacesThanAllowed) {
  const LineMap map = LineMap::build(irregular_plan());
  PlaceIndexOptions options;
  options.most_places = 300.0;
  const PlaceIndex index = PlaceIndex::build(map, options);
  EXPECT_LE(index.size(), 350u);
  EXPECT_GT(index.pitch_m(), options.pitch_m);
}

TEST(Relocator, FindsPosesInAnIrregularPlan) {
  const LineMap map = LineMap::build(irregular_plan());
  const PlaceIndex index = PlaceIndex::build(map);
  for (const Pose2& truth : {Pose2{20.3, 18.2, 0.4}, Pose2{2.4, 17.9, -2.0}, Pose2{19.1, 33.5, 3.0},
                             Pose2{41.2, 19.3, 1.2}}) {
    SCOPED_TRACE(truth.vector().transpose());
    const RelocationResult result = locate(map, index, scan_from(map, truth));
    EXPECT_EQ(result.verdict, Status::ok);
    ASSERT_FALSE(result.poses.empty());
    EXPECT_TRUE(is_at(result.poses.front().pose, truth, 0.05, 0.01));
  }
}

TEST(Relocator, FindsPosesByCornersInAPlanTooLargeForPlaces) {
  const LineMap map = LineMap::build(irregular_plan());
  PlaceIndexOptions options;
  options.most_places = 10.0;
  const PlaceIndex index = PlaceIndex::build(map, options);
  ASSERT_TRUE(index.empty());
  for (const Pose2& truth : {Pose2{20.5, 18.0, 0.7}, Pose2{2.5, 12.0, -2.0}}) {
    const RelocationResult result = locate(map, index, scan_from(map, truth));
    ASSERT_FALSE(result.poses.empty());
    EXPECT_TRUE(is_at(result.poses.front().pose, truth, 0.1, radians(1.0)));
  }
}

TEST(Relocator, FindsThePoseBesideClutter) {
  const LineMap map = LineMap::build(irregular_plan());
  const PlaceIndex index = PlaceIndex::build(map);
  const Pose2 truth{20.3, 18.2, 0.4};
  LaserScan scan = scan_from(map, truth);
  add_clutter(scan, 40, 25);
  add_clutter(scan, 200, 25);
  const RelocationResult result = locate(map, index, scan);
  ASSERT_FALSE(result.poses.empty());
  EXPECT_TRUE(is_at(result.poses.front().pose, truth, 0.05, 0.01));
}

TEST(Relocator, AViewOfAnEighthOfATurnIsNotTrusted) {
  const LineMap map = LineMap::build(irregular_plan());
  const PlaceIndex index = PlaceIndex::build(map);
  const Pose2 truth{20.3, 18.2, 0.4};
  LaserScan scan = scan_from(map, truth);
  EXPECT_EQ(locate(map, index, scan).verdict, Status::ok);
  scan.ranges.resize(45);
  const Status verdict = locate(map, index, scan).verdict;
  EXPECT_TRUE(verdict == Status::ambiguous || verdict == Status::lost) << to_string(verdict);
}

/// What is asked of a pose grows with the returns from behind walls, and with what is unexplained.
TEST(Relocator, WhatSpeaksForChanceAsksForALongerLead) {
  const LineMap map = LineMap::build(irregular_plan());
  const PlaceIndex index = PlaceIndex::build(map);
  const Pose2 truth{20.3, 18.2, 0.4};
  LaserScan scan = scan_from(map, truth);
  for (std::size_t beam = 100; beam < 120; ++beam) scan.ranges[beam] += 2.5;
  add_clutter(scan, 200, 40);
  const ScannerModel model = scanner();
  const MapError error = map_error();
  const auto verdict = [&](const RelocationOptions& options) {
    Relocator relocator(map, index);
    const RelocationResult& result = relocator.locate({scan, model, error, {}, {}}, options);
    EXPECT_TRUE(is_at(result.poses.front().pose, truth, 0.1, 0.02));
    EXPECT_GT(result.shares.through, 0.03);
    return result.verdict;
  };
  RelocationOptions lenient;
  lenient.sure_gap_per_through = 0.0;
  EXPECT_EQ(verdict(lenient), Status::ok);
  RelocationOptions strict = lenient;
  strict.sure_gap_per_through = 5000.0;
  EXPECT_EQ(verdict(strict), Status::ambiguous);
  strict = lenient;
  strict.sure_gap_per_evidence = 1e6;
  EXPECT_EQ(verdict(strict), Status::ambiguous);
}

TEST(Relocator, AnswersForTheVehicleNotForItsLaser) {
  const LineMap map = LineMap::build(irregular_plan());
  const PlaceIndex index = PlaceIndex::build(map);
  const Pose2 truth{20.3, 18.2, 0.4};
  const RelocationResult result = locate(map, index, scan_from(map, truth, {0.8, -0.3, 0.7}));
  ASSERT_FALSE(result.poses.empty());
  EXPECT_TRUE(is_at(result.poses.front().pose, truth, 0.05, 0.01));
}

TEST(Relocator, WeightsOfThePosesSumToOne) {
  const LineMap map = LineMap::build(regular_plan(6));
  const PlaceIndex index = PlaceIndex::build(map);
  const RelocationResult result = locate(map, index, scan_from(map, {57.0, 57.0, 0.3}));
  double sum = 0.0;
  for (std::size_t i = 0; i < result.poses.size(); ++i) {
    sum += result.poses[i].weight;
    EXPECT_LE(result.poses[i].weight, result.poses[i > 0 ? i - 1 : 0].weight);
    EXPECT_TRUE(result.poses[i].covariance.allFinite());
    EXPECT_GT(result.poses[i].covariance.determinant(), 0.0);
  }
  EXPECT_NEAR(sum, 1.0, 1e-9);
  EXPECT_LE(result.poses.size(), 20u);
}

TEST(Relocator, CallsAPanelThatIsAlikeEverywhereAmbiguous) {
  const LineMap map = LineMap::build(regular_plan(6));
  const PlaceIndex index = PlaceIndex::build(map);
  for (const Pose2& truth : {Pose2{57.0, 57.0, 0.3}, Pose2{37.5, 61.0, -1.0}}) {
    EXPECT_EQ(locate(map, index, scan_from(map, truth)).verdict, Status::ambiguous);
  }
}

TEST(Relocator, IsLostOutsideOfThePlan) {
  const LineMap map = LineMap::build(irregular_plan());
  const PlaceIndex index = PlaceIndex::build(map);
  std::vector<Segment> cave;
  for (int i = 0; i < 40; ++i) {
    const auto corner = [](int k) -> Vector2d {
      return (9.0 + 3.0 * std::sin(2.7 * k)) * unit_vector(kTwoPi * k / 40.0);
    };
    cave.push_back({corner(i), corner((i + 1) % 40)});
  }
  const LaserScan scan = scan_from(LineMap::build(cave), {1.0, 0.5, 0.2});
  const Status verdict = locate(map, index, scan).verdict;
  EXPECT_TRUE(verdict == Status::lost || verdict == Status::ambiguous) << to_string(verdict);
}

TEST(Relocator, LooksOnlyWhereItIsTold) {
  const LineMap map = LineMap::build(irregular_plan());
  const PlaceIndex index = PlaceIndex::build(map);
  const Pose2 truth{20.3, 18.2, 0.4};
  const LaserScan scan = scan_from(map, truth);
  const RelocationResult near = locate(map, index, scan, SearchArea{{21.0, 18.0}, 4.0});
  ASSERT_FALSE(near.poses.empty());
  EXPECT_TRUE(is_at(near.poses.front().pose, truth, 0.05, 0.01));
  const RelocationResult far = locate(map, index, scan, SearchArea{{2.0, 2.0}, 3.0});
  EXPECT_FALSE(far.poses.empty());
  for (const RankedPose& pose : far.poses) {
    EXPECT_LT((pose.pose.translation() - Vector2d(2.0, 2.0)).norm(), 6.0);
  }
}

/// A first look so narrow that it takes one of many pillars for the only one, and a second.
TEST(Relocator, LooksAgainWhereTheFirstLookLeavesADoubt) {
  const LineMap map = LineMap::build(regular_plan(6));
  const PlaceIndex index = PlaceIndex::build(map);
  const LaserScan scan = scan_from(map, {57.0, 57.0, 0.3});
  const ScannerModel model = scanner();
  const MapError error = map_error();
  RelocationOptions narrow;
  narrow.fewest_candidates = narrow.candidates = 1;
  const auto verdict = [&](double second_look_gap) {
    narrow.second_look_gap = second_look_gap;
    Relocator relocator(map, index);
    return relocator.locate({scan, model, error, {}, {}}, narrow).verdict;
  };
  EXPECT_EQ(verdict(0.0), Status::ok) << "there is none";
  EXPECT_EQ(verdict(100.0), Status::ok) << "one pose alone is settled";
  EXPECT_EQ(verdict(1e9), Status::ambiguous);
}

TEST(Relocator, WidenedCountsStayWithinTheirType) {
  RelocationOptions options;
  options.rated_again = std::numeric_limits<int>::max() - 1;
  EXPECT_GT(widened(options).rated_again, 0);
  EXPECT_EQ(widened(RelocationOptions{}).moved, 2 * RelocationOptions{}.moved);
}

TEST(Relocator, AnswersAScanWithBearingsOfItsOwnAlike) {
  const LineMap map = LineMap::build(irregular_plan());
  const PlaceIndex index = PlaceIndex::build(map);
  LaserScan scan = scan_from(map, {20.3, 18.2, 0.4});
  const RelocationResult even = locate(map, index, scan);
  std::vector<double> bearings;
  for (std::size_t i = 0; i < scan.ranges.size(); ++i) bearings.push_back(scan.bearing(i));
  scan.bearings = bearings;
  const RelocationResult own = locate(map, index, scan);
  EXPECT_EQ(own.verdict, Status::ok);
  ASSERT_FALSE(own.poses.empty());
  EXPECT_TRUE(is_at(own.poses.front().pose, even.poses.front().pose, 1e-3, 1e-3));
}

TEST(Relocator, SaysLostWhereThereIsNothingToGoBy) {
  const LineMap empty;
  const PlaceIndex none = PlaceIndex::build(empty);
  EXPECT_TRUE(none.empty());
  const LineMap map = LineMap::build(irregular_plan());
  const PlaceIndex index = PlaceIndex::build(map);
  const LaserScan good = scan_from(map, {20.3, 18.2, 0.4});
  EXPECT_EQ(locate(empty, none, good).verdict, Status::lost);
  LaserScan blind = good;
  blind.ranges.assign(blind.ranges.size(), std::numeric_limits<double>::infinity());
  EXPECT_EQ(locate(map, index, blind).verdict, Status::lost);
  LaserScan without_beams = good;
  without_beams.ranges.clear();
  EXPECT_EQ(locate(map, index, without_beams).verdict, Status::lost);
}

}  // namespace
}  // namespace adit
