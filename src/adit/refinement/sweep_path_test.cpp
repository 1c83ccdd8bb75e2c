#include "adit/refinement/sweep_path.hpp"

#include <gtest/gtest.h>

namespace adit {
namespace {

const Twist2 kDrive{5.0, -0.5, radians(60.0)};

void expect_near(const Pose2& a, const Pose2& b, double tolerance) {
  EXPECT_NEAR(a.x, b.x, tolerance);
  EXPECT_NEAR(a.y, b.y, tolerance);
  EXPECT_NEAR(angle_between(a.theta, b.theta), 0.0, tolerance);
}

ScannerModel scanner(SweepMoment stamp) {
  ScannerModel model;
  model.sweep_s = 0.2;
  model.stamp = stamp;
  return model;
}

TEST(SweepPath, OfASteadyMotionIsThatMotion) {
  for (const SweepMoment stamp : {SweepMoment::start, SweepMoment::middle, SweepMoment::end}) {
    const SweepTiming timing = sweep_timing(scanner(stamp), 500);
    const SweepPath path = steady_path(kDrive, timing, 500);
    for (std::size_t beam = 0; beam < 500; ++beam) {
      // A sixteenth of the sweep's arc is that straight.
      expect_near(path.at(timing.at(beam)), moved(kDrive, timing.at(beam)), 2e-4);
    }
    for (std::size_t k = 0; k <= SweepPath::kSteps; ++k) {
      expect_near(path.at(path.time(k)), path.stamp_from_vehicle[k], 1e-12);
    }
    expect_near(path.at(0.0), {}, 1e-12);
  }
}

TEST(SweepPath, StandsBeforeItsBeginAndAfterItsEnd) {
  const SweepPath path = steady_path(kDrive, sweep_timing(scanner(SweepMoment::middle), 500), 500);
  expect_near(path.at(-3.0), moved(kDrive, -0.1), 1e-12);
  expect_near(path.at(3.0), moved(kDrive, 0.1), 1e-12);
}

TEST(SweepPath, OfAScannerThatTakesAllAtOnceHasNoLength) {
  expect_near(SweepPath{}.at(0.3), {}, 0.0);
  expect_near(steady_path(kDrive, sweep_timing(ScannerModel{}, 500), 500).at(0.3), {}, 0.0);
}

TEST(SweepCorrection, OfOneMotionInBothHalvesIsThatMotion) {
  for (const double middle : {-0.1, 0.0, 0.1}) {
    SweepCorrection correction;
    correction.halves = {kDrive, kDrive};
    correction.middle_s = middle;
    for (const double seconds : {-0.2, -0.1, -0.03, 0.0, 0.05, 0.1, 0.2}) {
      expect_near(correction.at(seconds), moved(kDrive, seconds), 1e-12);
    }
  }
}

TEST(SweepCorrection, EachHalfActsInItsOwnTime) {
  SweepCorrection correction;
  correction.halves = {kDrive, Twist2{}};
  correction.middle_s = 0.1;  // the stamp is the begin
  expect_near(correction.at(0.06), moved(kDrive, 0.06), 1e-12);
  expect_near(correction.at(0.15), moved(kDrive, 0.1), 1e-12);
  correction.middle_s = -0.1;  // the stamp is the end
  expect_near(correction.at(-0.08), {}, 1e-12);
  expect_near(correction.at(-0.18), moved(kDrive, -0.08), 1e-12);
  correction.middle_s = 0.0;
  expect_near(correction.at(-0.07), moved(kDrive, -0.07), 1e-12);
  expect_near(correction.at(0.07), {}, 1e-12);
}

}  // namespace
}  // namespace adit
