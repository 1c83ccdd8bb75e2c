// Lost poses: what is said while the whole mine is searched, and that the right one comes back.

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "adit/localizer/localizer.hpp"
#include "support/mockup_run.hpp"

namespace adit {
namespace {

double position_error(const Estimate& e, const Pose2& truth) {
  return (e.pose.translation() - truth.translation()).norm();
}

bool is_trusted(const Estimate& e) {
  return e.status == Status::ok || e.status == Status::degraded;
}

/// How a run went.
struct Course {
  int trusted = 0;
  int trusted_wrong = 0;
  int ambiguous = 0;
  bool ends_trusted = false;
};

void note(const Estimate& e, const Pose2& truth, Course& course) {
  course.trusted += is_trusted(e) ? 1 : 0;
  course.trusted_wrong += is_trusted(e) && position_error(e, truth) > 0.5 ? 1 : 0;
  course.ambiguous += e.status == Status::ambiguous ? 1 : 0;
  course.ends_trusted = is_trusted(e);
}

TEST(Recovery, AKidnappedVehicleIsFoundAgain) {
  for (const std::uint64_t seed : {22, 23, 24, 25}) {
    const LineMap map = LineMap::build(mockup().plan);
    const Recording recording = test::record_mockup(seed, 5);
    Localizer localizer(map, test::mockup_settings());
    localizer.start(recording.first_guess.pose, recording.first_guess.covariance);
    for (std::size_t i = 0; i < 4; ++i) {
      localizer.update(recording.scans[i], recording.odometry[i]);
    }
    Course course;
    for (std::size_t i = 8; i < 16; ++i) {  // carried off by four stops; the wheels know nothing
      const Pose2 wheels =
          recording.odometry[3] * (inverse(recording.odometry[7]) * recording.odometry[i]);
      note(localizer.update(recording.scans[i], wheels), recording.truth[i].pose, course);
    }
    EXPECT_EQ(course.trusted_wrong, 0) << seed;
    EXPECT_TRUE(course.ends_trusted) << seed;
    EXPECT_GE(course.trusted, 2) << seed;
  }
}

TEST(Recovery, AVehicleThatMayBeAnywhereIsFound) {
  const LineMap map = LineMap::build(mockup().plan);
  const Recording recording = test::record_mockup(31, 5);
  Localizer localizer(map, test::mockup_settings());
  localizer.start_anywhere();
  Course course;
  for (std::size_t i = 0; i < recording.scans.size(); ++i) {
    const Estimate& e = localizer.update(recording.scans[i], recording.odometry[i]);
    if (i == 0) {
      EXPECT_EQ(e.status, Status::lost);
      EXPECT_TRUE(std::isinf(e.covariance(0, 0)));
      EXPECT_TRUE(std::isinf(e.protection_m));
    }
    note(e, recording.truth[i].pose, course);
  }
  EXPECT_EQ(course.trusted_wrong, 0);
  EXPECT_GE(course.trusted, 10);
}

TEST(Recovery, AStartFarFromTheTruthIsNoStart) {
  const LineMap map = LineMap::build(mockup().plan);
  const Recording recording = test::record_mockup(32, 5);
  Localizer localizer(map, test::mockup_settings());
  localizer.start(recording.truth[8].pose);  // the vehicle is at the first stop
  Course course;
  for (std::size_t i = 0; i < recording.scans.size(); ++i) {
    note(localizer.update(recording.scans[i], recording.odometry[i]), recording.truth[i].pose,
         course);
  }
  EXPECT_EQ(course.trusted_wrong, 0);
  EXPECT_GE(course.trusted, 8);
}

/// Square pillars, all alike, in a square room.
std::vector<Segment> regular_panel(int pillars) {
  std::vector<Segment> plan;
  const auto box = [&](double x0, double y0, double x1, double y1) {
    const Vector2d a(x0, y0), b(x1, y0), c(x1, y1), d(x0, y1);
    for (const Segment& side : {Segment{a, b}, Segment{b, c}, Segment{c, d}, Segment{d, a}}) {
      plan.push_back(side);
    }
  };
  const double pitch = 16.0;
  box(0.0, 0.0, pitch * pillars + 6.0, pitch * pillars + 6.0);
  for (int row = 0; row < pillars; ++row) {
    for (int column = 0; column < pillars; ++column) {
      box(pitch * column + 6.0, pitch * row + 6.0, pitch * (column + 1), pitch * (row + 1));
    }
  }
  return plan;
}

// The middle of a regular panel looks the same everywhere.
TEST(Recovery, WhereAllPillarsAreAlikeNoPoseIsTrusted) {
  const World world = from_plan(regular_panel(7));
  const LineMap map = LineMap::build(world.plan);
  const RayCaster caster(world.walls);
  ScannerSpec scanner = sick_lms();
  scanner.model.max_range_m = 15.0;
  LocalizerSettings settings;
  settings.scanner = scanner.model;
  settings.odometry = mockup_odometry();
  settings.map.sigma_m = 0.02;
  Random random(5);
  Localizer localizer(map, settings);
  localizer.start_anywhere();
  Course middle;
  Course edge;
  for (int i = 0; i < 50; ++i) {  // along a crosscut to the outline
    const Pose2 truth{51.0, 50.0 + std::min(1.2 * i, 58.0), 0.5 * kPi + 0.1 * std::sin(i)};
    LaserScan scan = simulate_scan(caster, truth, scanner, random);
    scan.stamp = i;
    note(localizer.update(scan, truth), truth, i < 25 ? middle : edge);
  }
  EXPECT_EQ(middle.trusted_wrong, 0);
  EXPECT_EQ(edge.trusted_wrong, 0);
  EXPECT_EQ(middle.trusted, 0);
  EXPECT_GT(middle.ambiguous, 15);
}

TEST(Recovery, NoPoseIsTrustedOutsideThePlan) {
  const World elsewhere = from_plan({{{0, 0}, {12, 1}}, {{12, 1}, {3, 13}}, {{3, 13}, {0, 0}}});
  const LineMap map = LineMap::build(mockup().plan);
  const RayCaster caster(elsewhere.walls);
  Random random(6);
  Localizer localizer(map, test::mockup_settings());
  localizer.start_anywhere();
  for (int i = 0; i < 15; ++i) {
    const Pose2 truth{3.0 + 0.3 * i, 2.5, 0.1};
    LaserScan scan = simulate_scan(caster, truth, cyclone(), random);
    scan.stamp = i;
    EXPECT_FALSE(is_trusted(localizer.update(scan, truth))) << i;
  }
}

TEST(Recovery, ASearchBesideTheCycleGivesTheSameBitsEachTime) {
  const LineMap map = LineMap::build(mockup().plan);
  const Recording recording = test::record_mockup(33, 8);
  const auto run = [&] {
    Localizer localizer(map, test::mockup_settings());
    localizer.start_anywhere();
    std::vector<Vector3d> poses;
    for (std::size_t i = 0; i < recording.scans.size(); ++i) {
      poses.push_back(localizer.update(recording.scans[i], recording.odometry[i]).pose.vector());
    }
    return poses;
  };
  const std::vector<Vector3d> first = run();
  EXPECT_EQ(first, run());
  EXPECT_GT((first.back() - first.front()).norm(), 0.1);
}

}  // namespace
}  // namespace adit
