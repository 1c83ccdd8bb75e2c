// The real logs, where they are present.
#include <gtest/gtest.h>

#include <chrono>

#include "adit/io/carmen.hpp"
#include "support/test_files.hpp"

namespace adit {
namespace {

Log read(const std::string& path) {
  auto log = read_log(path);
  EXPECT_TRUE(log) << to_string(log.error());
  return log ? std::move(*log) : Log{};
}

TEST(CarmenData, Intel) {
  ADIT_DATA_FILE(path, "intel/log.clf");
  const auto begin = std::chrono::steady_clock::now();
  const Log log = read(path);
  const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - begin;
  RecordProperty("seconds", std::to_string(elapsed.count()));
  EXPECT_LT(elapsed.count(), 3.0);  // the target is 0.15: sanitizers and busy machines
  EXPECT_EQ(log.scans.size(), 10090u);
  EXPECT_EQ(log.odometry.size(), 19910u);
  ASSERT_EQ(log.summary.lasers.size(), 1u);
  EXPECT_EQ(log.summary.lasers[0].fewest_beams, 180u);
  EXPECT_EQ(log.summary.lasers[0].most_beams, 180u);
  EXPECT_EQ(log.summary.lasers[0].max_range, 81.83);
  EXPECT_EQ(log.summary.lasers[0].max_range_source, RangeSource::found);
  EXPECT_EQ(find_range_step(log, log.scans[0].laser), 0.01);
  ASSERT_EQ(log.summary.warnings.size(), 1u);
  EXPECT_EQ(log.summary.warnings[0].message, "scan stamped earlier than the one before");
  EXPECT_EQ(log.summary.warnings[0].count, 457);
  EXPECT_EQ(log.scans[0].scan.stamp, 976053557.767368);
  EXPECT_EQ(log.scans[0].odom_from_vehicle.vector(), Vector3d(4.775, -5.841, -1.686332));
}

TEST(CarmenData, IntelFull) {
  ADIT_DATA_FILE(path, "intel/full.clf");
  const Log log = read(path);
  EXPECT_EQ(log.scans.size(), 13631u);
  EXPECT_EQ(log.summary.lasers.at(0).max_range, 81.83);
}

TEST(CarmenData, Aces) {
  ADIT_DATA_FILE(path, "aces/log.clf");
  const Log log = read(path);
  EXPECT_EQ(log.scans.size(), 7374u);
  EXPECT_EQ(log.odometry.size(), 7375u);
  EXPECT_EQ(log.summary.lasers.at(0).max_range, 50.0);
  EXPECT_EQ(log.summary.lasers.at(0).max_range_source, RangeSource::found);
}

TEST(CarmenData, FrClinicIsMountedAndMixed) {
  ADIT_DATA_FILE(path, "fr-clinic/log.clf");
  const Log log = read(path);
  EXPECT_EQ(log.scans.size(), 1500u);
  EXPECT_TRUE(log.summary.warnings.empty());
  long odd = 0;
  for (const LogScan& entry : log.scans) {
    odd += entry.scan.ranges.size() == 181 ? 1 : 0;
    ASSERT_TRUE(entry.scan.ranges.size() == 180 || entry.scan.ranges.size() == 181);
    ASSERT_NEAR(entry.scan.vehicle_from_laser.x, 0.22, 2e-6);
    ASSERT_NEAR(entry.scan.vehicle_from_laser.y, 0.0, 2e-6);
    ASSERT_NEAR(entry.scan.vehicle_from_laser.theta, 0.0, 2e-6);
  }
  EXPECT_EQ(odd, 395);
  // Its lines say 81.90, but 81.83 is a code for "no return" just as 81.91 is.
  EXPECT_EQ(log.summary.lasers.at(0).max_range, 81.83);
  EXPECT_EQ(log.summary.lasers.at(0).max_range_source, RangeSource::found);
}

TEST(CarmenData, MineProfilesAreFullCircles) {
  for (const char* name :
       {"chilean_mine/11S.clf", "chilean_mine/19S.clf", "chilean_mine/25S.clf"}) {
    ADIT_DATA_FILE(path, name);
    const Log log = read(path);
    ASSERT_EQ(log.scans.size(), 1u);
    EXPECT_EQ(log.scans[0].scan.ranges.size(), 1440u);
    EXPECT_TRUE(log.scans[0].scan.is_full_circle());
    EXPECT_EQ(log.scans[0].scan.max_range, 80.0);
    EXPECT_EQ(log.summary.lasers.at(0).max_range_source, RangeSource::field);
  }
}

}  // namespace
}  // namespace adit
