#include "adit/relocation/scan_likelihood.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "adit/visibility/visibility.hpp"

namespace adit {
namespace {

constexpr double kDoubt = 0.02;  // m

void add_box(double x0, double y0, double x1, double y1, std::vector<Segment>& plan) {
  const Vector2d a(x0, y0), b(x1, y0), c(x1, y1), d(x0, y1);
  for (const Segment& side : {Segment{a, b}, Segment{b, c}, Segment{c, d}, Segment{d, a}}) {
    plan.push_back(side);
  }
}

ScannerModel scanner() { return {.range_sigma_m = 0.02, .max_range_m = 50.0, .min_range_m = 0.1}; }

LaserScan scan_from(const std::vector<Segment>& walls, const Pose2& laser) {
  const LineMap map = LineMap::build(walls);
  LaserScan scan;
  scan.first_bearing = -kPi;
  scan.bearing_step = radians(1.0);
  scan.max_range = scanner().max_range_m;
  scan.ranges.resize(360);
  Visibility visibility;
  visibility.sweep(map, laser.translation(), scan.max_range);
  visibility.ranges(laser.theta - kPi, scan.bearing_step, scan.ranges);
  return scan;
}

double likelihood(const LineMap& map, const LaserScan& scan, const Pose2& laser,
                  const WallField* walls = nullptr) {
  LikelihoodOptions options;
  options.beams = 360;
  ScanLikelihood likelihood;
  if (walls != nullptr) likelihood.set_walls(*walls);
  likelihood.set_scan(scan, scanner(), {0.1, 1.5, 0.015}, options);
  return likelihood.at(map, laser, kDoubt);
}

/// A room of 20 m by 12 m; its upper wall lies off the plan by so much.
std::vector<Segment> room(double off) {
  std::vector<Segment> plan;
  add_box(0.0, 0.0, 20.0, 12.0 + off, plan);
  return plan;
}

TEST(ScanLikelihood, IsHighestWhereTheScanWasTaken) {
  const LineMap map = LineMap::build(room(0.0));
  const Pose2 truth{6.0, 5.0, 0.3};
  const LaserScan scan = scan_from(room(0.0), truth);
  const double there = likelihood(map, scan, truth);
  for (const Pose2& off :
       {Pose2{6.3, 5.0, 0.3}, Pose2{6.0, 5.3, 0.3}, Pose2{6.0, 5.0, 0.36}, Pose2{14.0, 7.0, 3.4}}) {
    EXPECT_GT(there, likelihood(map, scan, off) + 3.0);
  }
}

/// Each of a hundred beams on the wall is off by a whole sigma; were they independent, that would
/// cost half a unit a beam.
TEST(ScanLikelihood, CountsTheOffsetOfAWallOnceNotOnceABeam) {
  const LineMap map = LineMap::build(room(0.0));
  const Pose2 truth{10.0, 5.0, 0.3};
  const double exact = likelihood(map, scan_from(room(0.0), truth), truth);
  const double off = likelihood(map, scan_from(room(0.1), truth), truth);
  EXPECT_LT(off, exact);
  EXPECT_GT(off, exact - 15.0);
}

TEST(ScanLikelihood, KnowsTheWallBehindOneThatIsGone) {
  std::vector<Segment> plan = room(0.0);
  const std::vector<Segment> real = plan;
  plan.push_back({{13.0, 0.0}, {13.0, 12.0}});
  const LineMap map = LineMap::build(plan);
  const WallField walls(map);
  const Pose2 truth{5.0, 5.0, 0.3};
  const LaserScan scan = scan_from(real, truth);
  EXPECT_GT(likelihood(map, scan, truth, &walls), likelihood(map, scan, truth) + 50.0);
}

TEST(ScanLikelihood, SpeaksAgainstSeeingThroughRock) {
  std::vector<Segment> plan = room(0.0);
  plan.push_back({{13.0, 0.0}, {13.0, 12.0}});
  const LineMap map = LineMap::build(plan);
  const WallField walls(map);
  const Pose2 truth{5.0, 5.0, 0.3};
  EXPECT_GT(likelihood(map, scan_from(plan, truth), truth, &walls),
            likelihood(map, scan_from(room(0.0), truth), truth, &walls));
}

TEST(ScanLikelihood, FindsHowMuchThePlanErrs) {
  const LineMap map = LineMap::build(room(0.0));
  const Pose2 truth{6.0, 5.0, 0.3};
  const std::vector<double> ratios{1.0, 0.5, 0.25, 0.125};
  const auto best = [&](const LaserScan& scan) {
    ScanLikelihood likelihood;
    likelihood.set_scan(scan, scanner(), {0.1, 1.5, 0.015}, {});
    return likelihood.best_at(map, truth, kDoubt, ratios).error_ratio;
  };
  EXPECT_EQ(best(scan_from(room(0.0), truth)), 0.125);
  EXPECT_GT(best(scan_from(room(0.1), truth)), 0.125);
}

}  // namespace
}  // namespace adit
