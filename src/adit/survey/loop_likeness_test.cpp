#include <gtest/gtest.h>

#include "adit/simulation/ray_caster.hpp"
#include "adit/simulation/scanner.hpp"
#include "adit/simulation/world.hpp"
#include "adit/survey/loop_search.hpp"

namespace adit {
namespace {

/// A gallery from x = -20 m to 90 m whose niches begin at these places.
std::vector<Segment> gallery(const std::vector<double>& niches) {
  std::vector<Vector2d> points = {{-20.0, -1.2}};
  for (const double x : niches) {
    for (const Vector2d& p : {Vector2d(x, -1.2), {x, -3.0}, {x + 2, -3.0}, {x + 2, -1.2}}) {
      points.push_back(p);
    }
  }
  for (const Vector2d& p : {Vector2d(90.0, -1.2), {90.0, 1.2}, {-20.0, 1.2}}) points.push_back(p);
  return outline(points);
}

ScanShape seen_from(double x, const RayCaster& caster, Random& random) {
  ScannerSpec scanner = sick_lms();
  scanner.model.max_range_m = 8.0;
  scanner.beams = 360;
  LaserScan scan;
  scan.first_bearing = -kPi;
  scan.bearing_step = kTwoPi / scanner.beams;
  scan.max_range = scanner.model.max_range_m;
  for (int i = 0; i < scanner.beams; ++i) {
    const Vector2d beam = unit_vector(scan.first_bearing + i * scan.bearing_step);
    scan.ranges.push_back(reported_range(caster.range({x, 0.0}, beam), scanner, random));
  }
  return SurfaceMaker().shape(scan, scanner.model, {});
}

/// 40 m of way past the niches; then a way of which nothing is known to within metres; then a
/// stretch that was never seen before, with a niche where the one at 35 m may be.
std::size_t closures_found(const std::vector<double>& niches, const LoopOptions& options) {
  const RayCaster caster(gallery(niches));
  Random random(6);
  std::vector<Keyframe> keyframes;
  std::vector<Pose2> poses;
  std::vector<PoseConstraint> chain;
  for (std::size_t i = 0; i < 54; ++i) {
    const double believed = static_cast<double>(i < 40 ? i : i - 10);
    Keyframe k;
    k.shape = seen_from(i < 40 ? believed : believed + 32.0, caster, random);
    k.beam_sigma_m = 0.015;
    poses.push_back({believed, 0.0, 0.0});
    keyframes.push_back(std::move(k));
    if (i == 0) continue;
    const Vector3d sigmas(i == 40 ? 4.0 : 0.01, 0.01, 0.002);
    chain.push_back({i - 1, i, inverse(poses[i - 1]) * poses[i],
                     sigmas.cwiseAbs2().cwiseInverse().asDiagonal(), 0.0});
  }
  const DriftBound drift(poses.size(), chain);
  const LoopScene scene{keyframes, poses, drift, 8.0};
  std::size_t across_the_gap = 0;
  for (const Closure& c : search_loops(scene, {}, options, {}, 1)) {
    across_the_gap += c.from < 40 && c.to >= 40;
  }
  return across_the_gap;
}

LoopOptions near_options() {
  LoopOptions options;
  options.least_apart = 9;
  options.target_keyframes = 7;
  options.query_stride = 1;
  options.target_stride = 1;
  return options;
}

TEST(LoopLikeness, WhereSurroundingsRepeatThemselvesNothingIsClosed) {
  EXPECT_EQ(closures_found({3, 19, 35, 67}, near_options()), 0U);
}

TEST(LoopLikeness, WithoutTheCheckOneNicheIsTakenForAnother) {
  LoopOptions careless = near_options();
  careless.likeness_margin = -1.0;  // nothing can be so much better
  EXPECT_GT(closures_found({3, 19, 35, 67}, careless), 0U);
}

TEST(LoopLikeness, WhatIsAloneInItsSurroundingsMayBeClosed) {
  EXPECT_GT(closures_found({35, 67}, near_options()), 0U);
}

}  // namespace
}  // namespace adit
