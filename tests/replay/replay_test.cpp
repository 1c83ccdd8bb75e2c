// What the command makes of a log's messages, whatever their order.
#include "apps/replay.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <span>

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
    return format_estimates(replay(log, map_, settings_, start(), nullptr).rows);
  }
  Beginning start() const { return {false, recording_.first_guess.pose, std::nullopt}; }

  /// What a machine says: it uses a scan when its sweep is over, and has the wheels until then.
  std::vector<EstimateRow> live(Localizer& localizer, std::size_t& fed) const {
    localizer.start(recording_.first_guess.pose);
    std::vector<EstimateRow> rows;
    for (std::size_t i = 0; i < recording_.scans.size(); ++i) {
      const double sweep_end = recording_.scans[i].stamp + 0.5 * settings_.scanner.sweep_s;
      for (; fed < recording_.wheels.size() && recording_.wheels[fed].stamp <= sweep_end; ++fed) {
        localizer.add_odometry(recording_.wheels[fed]);
      }
      rows.push_back(to_row(localizer.update(log_.scans[i].scan, recording_.odometry[i])));
    }
    return rows;
  }

  LineMap map_;
  LocalizerSettings settings_;
  Recording recording_;
  Log log_;
};

TEST_F(Drive, AReplayIsWhatTheMachineWouldHaveSaid) {
  Localizer localizer(map_, settings_);
  std::size_t fed = 0;
  const std::vector<EstimateRow> rows = live(localizer, fed);
  // The wheels' ten messages a scan, from the begin of the first sweep to the end of the last.
  EXPECT_NEAR(static_cast<double>(fed), 10.0 * static_cast<double>(rows.size()) + 1.0, 1.0);
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
    const Replay result = replay(log, map_, settings_, start(), nullptr);
    ASSERT_EQ(result.rows.size(), recording_.truth.size());
    for (std::size_t i = 0; i < result.rows.size(); ++i) {
      const Vector2d truth = recording_.truth[i].pose.translation();
      EXPECT_LT((result.rows[i].pose.translation() - truth).norm(), 0.3) << i;
    }
  }
}

TEST_F(Drive, SaysWhatWasLearnt) {
  settings_.map.sigma_m = 0.1;  // stated, though the plan is exact
  Localizer localizer(map_, settings_);
  std::size_t fed = 0;
  live(localizer, fed);
  const Replay result = replay(log_, map_, settings_, start(), nullptr);
  EXPECT_EQ(result.map_error.offset_sigma_m, localizer.last_turn().map_error.offset_sigma_m);
  EXPECT_EQ(result.map_error.length_m, localizer.last_turn().map_error.length_m);
  EXPECT_EQ(result.map_error.roughness_sigma_m, localizer.last_turn().map_error.roughness_sigma_m);
  EXPECT_LT(result.map_error.sigma_m(), 0.05);
}

TEST_F(Drive, SaysWhatWasMet) {
  Log odd = log_;
  const std::size_t count = odd.scans.size();
  odd.scans[5] = odd.scans[4];
  std::swap(odd.scans[10].scan.stamp, odd.scans[11].scan.stamp);
  for (std::size_t i = 20; i < count; ++i) odd.scans[i].scan.stamp += 10.0;
  for (std::size_t i = 30; i < count; ++i) odd.scans[i].scan.stamp += 1e6;
  const Replay result = replay(odd, map_, settings_, start(), nullptr);
  EXPECT_EQ(result.stamps.duplicates, 1);
  EXPECT_EQ(result.stamps.late, 1);
  EXPECT_EQ(result.stamps.gaps, 1);
  EXPECT_EQ(result.stamps.jumps, 1);
  ASSERT_EQ(result.timings.size(), count);
  ASSERT_EQ(result.search_calls.size(), count);
  for (std::size_t i = 0; i < count; ++i) {
    EXPECT_EQ(result.rows[i].stamp, odd.scans[i].scan.stamp) << i;
    EXPECT_GT(result.timings[i].refinement, 0.0) << i;
  }
  // A scan that comes twice says nothing new.
  const std::span<const EstimateRow> rows(result.rows);
  EXPECT_EQ(format_estimates(rows.subspan(5, 1)), format_estimates(rows.subspan(4, 1)));
}

}  // namespace
}  // namespace adit
