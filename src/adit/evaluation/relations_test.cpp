#include "adit/evaluation/relations.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cstdlib>
#include <fstream>
#include <limits>
#include <string>

namespace adit {
namespace {

std::vector<EstimateSample> samples(const std::vector<StampedPose>& trajectory) {
  return samples_of(std::span<const StampedPose>(trajectory));
}

TEST(Relations, HandComputed) {
  // At 1 s the vehicle faces north at (1, 2); at 2 s it is 3 m further north and faces west.
  const auto run = samples({{1.0, {1.0, 2.0, radians(90.0)}}, {2.0, {1.0, 5.0, kPi}}});
  const std::vector<Relation> relations = {
      {1.0, 2.0, {3.0, 0.0, radians(90.0)}},   // as estimated
      {1.0, 2.0, {3.0, -0.4, radians(80.0)}},  // 0.4 m and 10 degrees off
      {1.0, 2.0, {2.7, 0.4, radians(120.0)}},  // 0.5 m and 30 degrees off
      {2.0, 1.0, {0.0, 3.0, radians(-90.0)}},  // backwards, as estimated
      {1.0, 9.0, {}},                          // no estimate there
      {9.0, 1.0, {}},
  };
  const RelationsMetric metric = relations_metric(run, relations);
  EXPECT_EQ(metric.count, 6);
  EXPECT_EQ(metric.matched, 4);
  EXPECT_NEAR(metric.translation_mean, 0.9 / 4.0, 1e-12);
  const double squares = 0.16 + 0.25;
  EXPECT_NEAR(metric.translation_std, std::sqrt(squares / 4.0 - 0.225 * 0.225), 1e-12);
  EXPECT_NEAR(metric.translation_squared_mean, squares / 4.0, 1e-12);
  const double fourths = 0.16 * 0.16 + 0.25 * 0.25;
  EXPECT_NEAR(metric.translation_squared_std, std::sqrt(fourths / 4.0 - squares * squares / 16.0),
              1e-12);
  EXPECT_NEAR(metric.translation_max, 0.5, 1e-12);
  EXPECT_NEAR(metric.rotation_mean_deg, 10.0, 1e-9);
  EXPECT_NEAR(metric.rotation_std_deg, std::sqrt(1000.0 / 4.0 - 100.0), 1e-9);
  EXPECT_NEAR(metric.rotation_max_deg, 30.0, 1e-9);
}

TEST(Relations, NothingMatchedIsNotANumber) {
  const std::vector<Relation> relations = {{1.0, 2.0, {}}};
  const RelationsMetric metric = relations_metric({}, relations);
  EXPECT_EQ(metric.count, 1);
  EXPECT_EQ(metric.matched, 0);
  EXPECT_TRUE(std::isnan(metric.translation_mean));
  EXPECT_TRUE(std::isnan(metric.rotation_max_deg));
}

TEST(Relations, AnEstimateWithoutNumberErrsInfinitely) {
  const auto run =
      samples({{1.0, {}}, {2.0, {std::numeric_limits<double>::quiet_NaN(), 0.0, 0.0}}});
  const std::vector<Relation> relations = {{1.0, 2.0, {}}};
  const RelationsMetric metric = relations_metric(run, relations);
  EXPECT_EQ(metric.matched, 1);
  EXPECT_TRUE(std::isinf(metric.translation_mean));
}

Pose2 any_pose() {
  const auto coordinate = [] { return *rc::gen::inRange(-1000000, 1000001) / 1e4; };
  return {coordinate(), coordinate(), wrap_angle(coordinate())};
}

RC_GTEST_PROP(Relations, DoNotSeeARigidMotionOfTheWholeRun, ()) {
  std::vector<StampedPose> truth;
  for (int i = 0; i < 8; ++i) truth.push_back({0.5 * i, any_pose()});
  std::vector<Relation> relations;
  for (const StampedPose& from : truth) {
    for (const StampedPose& to : truth) {
      relations.push_back({from.stamp, to.stamp, inverse(from.pose) * to.pose});
    }
  }
  const Pose2 motion = any_pose();
  std::vector<StampedPose> moved = truth;
  for (StampedPose& row : moved) row.pose = motion * row.pose;
  const RelationsMetric metric = relations_metric(samples(moved), relations);
  RC_ASSERT(metric.matched == 64);
  RC_ASSERT(metric.translation_max < 1e-9);
  RC_ASSERT(metric.rotation_max_deg < 1e-9);
}

RC_GTEST_PROP(Relations, SeeEachErrorInTheFrameOfTheVehicle, ()) {
  const Pose2 from = any_pose();
  const Pose2 to = any_pose();
  const Pose2 slip{0.01 * *rc::gen::inRange(-100, 101), 0.02, 0.001 * *rc::gen::inRange(-99, 100)};
  const std::vector<Relation> relations = {{0.0, 1.0, inverse(from) * to}};
  const RelationsMetric metric =
      relations_metric(samples({{0.0, from}, {1.0, to * slip}}), relations);
  RC_ASSERT(std::abs(metric.translation_mean - slip.translation().norm()) < 1e-9);
  RC_ASSERT(std::abs(metric.rotation_mean_deg - degrees(std::abs(slip.theta))) < 1e-9);
}

std::string data_file(const std::string& name) {
  const char* folder = std::getenv("ADIT_DATA");
  return folder == nullptr ? std::string() : std::string(folder) + "/" + name;
}

TEST(Relations, IntelReferenceIsAsGoodAsItsNotesSay) {
  std::ifstream poses(data_file("intel/reference.tum"));
  std::ifstream pairs(data_file("intel/relations.txt"));
  if (!poses || !pairs) GTEST_SKIP() << "set ADIT_DATA to the folder that holds intel/";
  std::vector<StampedPose> reference;
  double t = 0, x = 0, y = 0, z = 0, qx = 0, qy = 0, qz = 0, qw = 0;
  while (poses >> t >> x >> y >> z >> qx >> qy >> qz >> qw) {
    reference.push_back({t, {x, y, wrap_angle(2.0 * std::atan2(qz, qw))}});
  }
  std::vector<Relation> relations;
  double to = 0, roll = 0, pitch = 0, yaw = 0;
  while (pairs >> t >> to >> x >> y >> z >> roll >> pitch >> yaw) {
    relations.push_back({t, to, {x, y, yaw}});
  }
  ASSERT_EQ(reference.size(), 2672U);
  ASSERT_EQ(relations.size(), 2984U);
  const RelationsMetric metric = relations_metric(samples(reference), relations);
  // Of an independent computation outside this project's code.
  EXPECT_EQ(metric.matched, 350);
  EXPECT_NEAR(metric.translation_mean, 0.031330, 1e-6);
  EXPECT_NEAR(metric.translation_std, 0.022505, 1e-6);
  EXPECT_NEAR(metric.rotation_mean_deg, 0.594717, 1e-6);
  // The notes' 4.8 cm takes poses up to 50 ms beside the stamps of a relation as well.
  const RelationsMetric loose = relations_metric(samples(reference), relations, 0.05);
  EXPECT_EQ(loose.matched, 622);
  EXPECT_NEAR(loose.translation_mean, 0.048191, 1e-6);
}

}  // namespace
}  // namespace adit
