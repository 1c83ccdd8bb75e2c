// What the command makes of a log's messages, whatever their order.
#include "apps/replay.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "adit/io/carmen.hpp"
#include "adit/simulation/vehicle.hpp"
#include "apps/recording_log.hpp"

namespace adit {
namespace {

/// A drive through the mockup with a slow scanner, as its log and as what was really fed.
class Drive : public ::testing::Test {
 protected:
  Drive() : map_(LineMap::build(mockup().plan)) {
    ScannerSpec scanner = hokuyo();
    scanner.model.sweep_s = 0.2;
    scanner.model.stamp = SweepMoment::middle;
    DriveOptions drive;
    drive.speed_m_per_s = 2.0;
    settings_.scanner = scanner.model;
    settings_.odometry = drive.odometry;
    settings_.map.sigma_m = 0.01;
    recording_ = record_drive(mockup(), mockup_path(), scanner, drive, 3);
    const auto read = parse_log(format_carmen(to_log(recording_, scanner)));
    EXPECT_TRUE(read) << to_string(read.error());
    if (read) log_ = *read;
  }

  std::string replayed(const Log& log) const {
    return format_estimates(replay(log, map_, settings_, start()).rows);
  }
  Pose2 start() const { return recording_.first_guess.pose; }

  LineMap map_;
  LocalizerSettings settings_;
  Recording recording_;
  Log log_;
};

// A machine uses a scan when its sweep is over, and has the wheels until then.
TEST_F(Drive, AReplayIsWhatTheMachineWouldHaveSaid) {
  Localizer localizer(map_, settings_);
  localizer.start(start());
  std::vector<EstimateRow> rows;
  std::size_t fed = 0;
  for (std::size_t i = 0; i < recording_.scans.size(); ++i) {
    const double sweep_end = recording_.scans[i].stamp + 0.5 * settings_.scanner.sweep_s;
    for (; fed < recording_.wheels.size() && recording_.wheels[fed].stamp <= sweep_end; ++fed) {
      localizer.add_odometry(recording_.wheels[fed]);
    }
    rows.push_back(to_row(localizer.update(log_.scans[i].scan, recording_.odometry[i])));
  }
  ASSERT_GT(fed, 10 * rows.size() / 2);
  EXPECT_EQ(replayed(log_), format_estimates(rows));
}

// The wheels say more of the motion within a sweep than the poses at the scans do.
TEST_F(Drive, TheLogsOdometryIsUsed) {
  Log without = log_;
  without.odometry.clear();
  EXPECT_NE(replayed(log_), replayed(without));
}

TEST_F(Drive, MessagesOfAnotherClockAreLeftOut) {
  Log without = log_;
  without.odometry.clear();
  for (const double offset : {-1e6, 1e6}) {
    Log other = log_;
    for (StampedPose& message : other.odometry) message.stamp += offset;
    EXPECT_EQ(replayed(other), replayed(without)) << offset;
  }
}

TEST_F(Drive, MessagesInAnyOrderAreTakenIn) {
  Log reversed = log_;
  std::reverse(reversed.odometry.begin(), reversed.odometry.end());
  Log at_once = log_;
  for (LogScan& entry : at_once.scans) entry.odometry_before = at_once.odometry.size();
  Log many = log_;
  many.odometry.assign(200000, log_.odometry.front());
  for (const Log& log : {reversed, at_once, many}) {
    const Replay result = replay(log, map_, settings_, start());
    ASSERT_EQ(result.rows.size(), recording_.truth.size());
    for (std::size_t i = 0; i < result.rows.size(); ++i) {
      const Vector2d truth = recording_.truth[i].pose.translation();
      EXPECT_LT((result.rows[i].pose.translation() - truth).norm(), 0.3) << i;
    }
  }
}

TEST_F(Drive, SaysWhatWasLearntAndMet) {
  Log odd = log_;
  odd.scans[5].scan.stamp = odd.scans[4].scan.stamp;
  const Replay result = replay(odd, map_, settings_, start());
  EXPECT_EQ(result.stamps.duplicates, 1);
  EXPECT_EQ(result.timings.size(), odd.scans.size());
  EXPECT_GE(result.map_error.sigma_m(), 0.0);
  EXPECT_GT(result.map_error.length_m, 0.0);
}

}  // namespace
}  // namespace adit
