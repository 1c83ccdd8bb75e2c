#include "adit/io/carmen.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "support/test_files.hpp"

namespace adit {
namespace {

const std::string kFlaser = "FLASER 4 1 2 3.5 81.83 9 9 9 1 2 0.5 100.25 host 0.1\n";

Log log_of(const std::string& text, const LogOptions& options = {}) {
  auto log = parse_log(text, options, "log.clf");
  EXPECT_TRUE(log) << to_string(log.error());
  return log ? *log : Log{};
}

std::string error_of(std::string_view text) {
  const auto log = parse_log(text, {}, "log.clf");
  return log ? "no error" : to_string(log.error());
}

/// What is said about a line that stands after a good one.
std::string warning_of(const std::string& line) {
  const Log log = log_of(kFlaser + line);
  EXPECT_EQ(log.scans.size(), 1u) << line;
  return log.summary.warnings.empty() ? "no warning" : to_string(log.summary.warnings[0]);
}

/// A FLASER line of so many beams of 5 m.
std::string flaser_of(int beams, const std::string& name = "FLASER") {
  std::string line = name + " " + std::to_string(beams);
  for (int i = 0; i < beams; ++i) line += " 5";
  return line + " 0 0 0 0 0 0 1 host 1\n";
}

TEST(Carmen, FlaserGivesOdometryFromTheSecondPoseAndTheFirstStamp) {
  const Log log = log_of(kFlaser);
  ASSERT_EQ(log.scans.size(), 1u);
  const LogScan& entry = log.scans[0];
  EXPECT_EQ(entry.scan.stamp, 100.25);
  EXPECT_EQ(entry.odom_from_vehicle.vector(), Vector3d(1, 2, 0.5));
  EXPECT_EQ(entry.scan.ranges, (std::vector<double>{1, 2, 3.5, 81.83}));
  EXPECT_EQ(entry.scan.vehicle_from_laser.vector(), Vector3d::Zero());
  EXPECT_EQ(to_string(entry.laser), "FLASER");
  EXPECT_EQ(entry.line, 1);
}

TEST(Carmen, FlaserBearingsFollowTheParityOfTheCount) {
  for (const auto& [beams, step, last] : {std::tuple{180, 1.0, 89.0},
                                          {181, 1.0, 90.0},
                                          {360, 0.5, 89.5},
                                          {361, 0.5, 90.0},
                                          {2, 90.0, 0.0}}) {
    const Log log = log_of(flaser_of(beams));
    const LaserScan& scan = log.scans.at(0).scan;
    EXPECT_NEAR(degrees(scan.bearing(0)), -90.0, 1e-12);
    EXPECT_NEAR(degrees(scan.bearing_step), step, 1e-12);
    EXPECT_NEAR(degrees(scan.bearing(scan.ranges.size() - 1)), last, 1e-9);
  }
}

TEST(Carmen, RlaserLooksBackwardsFromItsOffset) {
  const Log log = log_of(
      "PARAM robot_frontlaser_offset 0.3 host 0\n"
      "PARAM robot_rearlaser_offset -0.2 host 0\n" +
      flaser_of(180, "RLASER") + flaser_of(180));
  ASSERT_EQ(log.scans.size(), 2u);
  EXPECT_EQ(log.scans[0].scan.vehicle_from_laser.vector(), Vector3d(-0.2, 0, kPi));
  EXPECT_EQ(log.scans[1].scan.vehicle_from_laser.vector(), Vector3d(0.3, 0, 0));
  EXPECT_EQ(log.summary.params.at("robot_rearlaser_offset"), "-0.2");
  // The beam straight ahead of the rear laser points to the vehicle's back.
  const Vector2d hit =
      log.scans[0].scan.vehicle_from_laser * (5.0 * unit_vector(log.scans[0].scan.bearing(90)));
  EXPECT_NEAR(hit.x(), -5.2, 1e-12);
  EXPECT_NEAR(hit.y(), 0.0, 1e-12);
}

TEST(Carmen, RobotlaserIsMountedWhereItsPoseSays) {
  const Log log = log_of(
      "ROBOTLASER2 0 -1.0 3.141593 0.01 30 0.05 0 3 1 2 3 2 7 x "
      "10 22 1.5707963267948966 10 20 1.5707963267948966 0 0 0 0 0 55.5 host 1\n");
  ASSERT_EQ(log.scans.size(), 1u);
  const LogScan& entry = log.scans[0];
  EXPECT_EQ(to_string(entry.laser), "ROBOTLASER2");
  EXPECT_NEAR((entry.scan.vehicle_from_laser.vector() - Vector3d(2, 0, 0)).norm(), 0.0, 1e-12);
  EXPECT_EQ(entry.odom_from_vehicle.vector(), Vector3d(10, 20, 1.5707963267948966));
  EXPECT_EQ(entry.scan.first_bearing, -1.0);
  EXPECT_EQ(entry.scan.bearing_step, 0.01);
  EXPECT_EQ(entry.scan.max_range, 30.0);
  EXPECT_EQ(entry.accuracy_m, 0.05);
  EXPECT_EQ(entry.scan.stamp, 55.5);
  EXPECT_EQ(log.summary.lasers[0].max_range_source, RangeSource::field);
}

TEST(Carmen, KeepsKindsApartAndInOrder) {
  const Log log =
      log_of("# comment\nODOM 1 2 3 0.1 0.2 0.3 10 host 1\n" + kFlaser +
             "TRUEPOS 7 8 0.25 1 2 3 11 host 1\r\nODOM 4 5 7 0 0 0 9.5 host 1\nSYNC tag 1 host 1\n"
             "NMEA-GGA 1 2 3\nSYNC tag 2 host 2\n" +
             flaser_of(5) + flaser_of(6));
  ASSERT_EQ(log.odometry.size(), 2u);
  EXPECT_EQ(log.odometry[0].stamp, 10.0);
  EXPECT_EQ(log.odometry[1].pose.x, 4.0);
  EXPECT_NEAR(log.odometry[1].pose.theta, 7.0 - kTwoPi, 1e-12);
  ASSERT_EQ(log.true_poses.size(), 1u);
  EXPECT_EQ(log.true_poses[0].stamp, 11.0);
  EXPECT_EQ(log.true_poses[0].pose.vector(), Vector3d(7, 8, 0.25));
  ASSERT_EQ(log.scans.size(), 3u);
  EXPECT_EQ(log.scans[2].line, 10);
  EXPECT_EQ(log.scans[0].odometry_before, 1u);
  EXPECT_EQ(log.scans[2].odometry_before, 2u);
  EXPECT_EQ(log.summary.ignored, (std::map<std::string, long>{{"SYNC", 2}, {"NMEA-GGA", 1}}));
  EXPECT_EQ(log.summary.lines, 10);
  ASSERT_EQ(log.summary.lasers.size(), 1u);
  EXPECT_EQ(log.summary.lasers[0].scans, 3);
  EXPECT_EQ(log.summary.lasers[0].fewest_beams, 4u);
  EXPECT_EQ(log.summary.lasers[0].most_beams, 6u);
}

TEST(Carmen, MaximumRangeComesFromTheConfigurationFirst) {
  const std::string text = "PARAM robot_front_laser_max 50.0 host 0\n" + kFlaser;
  const Log given = log_of(text, {.max_range_m = 20.0});
  EXPECT_EQ(given.scans[0].scan.max_range, 20.0);
  EXPECT_EQ(given.summary.lasers[0].max_range_source, RangeSource::configuration);
  const Log param = log_of(text);
  EXPECT_EQ(param.scans[0].scan.max_range, 50.0);
  EXPECT_EQ(param.summary.lasers[0].max_range_source, RangeSource::parameter);
  EXPECT_FALSE(param.scans[0].scan.has_return(3));
  EXPECT_TRUE(param.scans[0].scan.has_return(2));
}

TEST(Carmen, MaximumRangeIsFoundOrAssumed) {
  const Log found = log_of(kFlaser + kFlaser + kFlaser);
  EXPECT_EQ(found.summary.lasers[0].max_range_source, RangeSource::found);
  EXPECT_EQ(found.scans[1].scan.max_range, 81.83);
  const Log assumed = log_of("FLASER 4 1 2 3.5 7 0 0 0 0 0 0 1 host 1\n");
  EXPECT_EQ(assumed.summary.lasers[0].max_range_source, RangeSource::assumed);
  EXPECT_EQ(assumed.scans[0].scan.max_range, 80.0);
  const Log far = log_of("FLASER 4 1 2 3.5 200 0 0 0 0 0 0 1 host 1\n");
  EXPECT_TRUE(far.scans[0].scan.has_return(3));
}

TEST(Carmen, EachLaserHasItsOwnMaximumAndNumber) {
  std::string text;
  for (int i = 0; i < 3; ++i)
    text += kFlaser + "RLASER 4 1 2 3.5 30 9 9 9 1 2 0.5 100.25 host 0.1\n";
  const Log log = log_of(text);
  EXPECT_EQ(log.scans[0].scan.max_range, 81.83);
  EXPECT_EQ(log.scans[1].scan.max_range, 30.0);
  EXPECT_EQ(log.scans[2].scan.scanner, 0);
  EXPECT_EQ(log.scans[3].scan.scanner, 1);
}

TEST(Carmen, ReadingsMayBeNoNumbersAtAll) {
  const Log log = log_of("FLASER 4 1 nan inf -inf 0 0 0 0 0 0 1 host 1\n");
  EXPECT_TRUE(log.scans[0].scan.has_return(0));
  for (const std::size_t beam : {1u, 2u, 3u}) EXPECT_FALSE(log.scans[0].scan.has_return(beam));
}

TEST(Carmen, SkipsLinesThatCannotBeUsed) {
  EXPECT_EQ(warning_of("FLASER 4 1 2 3.5\n"),
            "line 2: FLASER line skipped: expected as many range readings as num_readings says");
  EXPECT_EQ(warning_of("FLASER x 1 2 3.5\n"), "line 2: FLASER line skipped: expected num_readings");
  EXPECT_EQ(warning_of("FLASER -1 1 2\n"), "line 2: FLASER line skipped: expected num_readings");
  EXPECT_EQ(warning_of("FLASER 2.5 1 2\n"), "line 2: FLASER line skipped: expected num_readings");
  EXPECT_EQ(warning_of("FLASER 1 5 0 0 0 0 0 0 1 h 1\n"),
            "line 2: FLASER line skipped: expected num_readings of 2 or more");
  EXPECT_EQ(warning_of("FLASER 2 5 5 0 0 0 0 nan 0 1 h 1\n"),
            "line 2: FLASER line skipped: expected odom_x odom_y odom_theta");
  EXPECT_EQ(warning_of("FLASER 2 5 5 0 0 0 0 0 0 12345\n"),
            "line 2: FLASER line skipped: expected ipc_hostname");
  EXPECT_EQ(warning_of("FLASER 3 5 5 0 0 0 0 0 0 12345 h 1\n"),
            "line 2: FLASER line skipped: expected ipc_timestamp");
  EXPECT_EQ(warning_of("ODOM 1 2\n"), "line 2: ODOM line skipped: expected x y theta");
  EXPECT_EQ(warning_of("TRUEPOS 1 2 3\n"),
            "line 2: TRUEPOS line skipped: expected odom_x odom_y odom_theta");
  EXPECT_EQ(warning_of("PARAM name\n"),
            "line 2: PARAM line skipped: expected param_name param_value");
  EXPECT_EQ(
      warning_of("ROBOTLASER1 0 0 0 0 80 0 0 1 5 0 0 0 0 0 0 0 0 0 0 0 0 1 h 1\n"),
      "line 2: ROBOTLASER1 line skipped: expected an angular_resolution in radians that makes at "
      "most one turn");
  EXPECT_EQ(
      warning_of("ROBOTLASER1 0 -90 180 4 80 0 0 2 5 5 0 0 0 0 0 0 0 0 0 0 0 0 1 h 1\n"),
      "line 2: ROBOTLASER1 line skipped: expected an angular_resolution in radians that makes at "
      "most one turn");
  EXPECT_EQ(warning_of("ODOM 1e308 2 0 0 0 0 1 h 1\n"),
            "line 2: ODOM line skipped: expected x y theta");
}

TEST(Carmen, CountsWarningsAndNamesTheFirstLine) {
  const Log log = log_of(kFlaser + "ODOM 1\n" + kFlaser + "ODOM x\n");
  ASSERT_EQ(log.summary.warnings.size(), 1u);
  EXPECT_EQ(log.summary.warnings[0].count, 2);
  EXPECT_EQ(log.summary.warnings[0].first_line, 2);
}

TEST(Carmen, EarlierStampsAreKeptAndCounted) {
  const Log log = log_of(
      "FLASER 2 5 5 0 0 0 0 0 0 10 h 1\nFLASER 2 5 5 0 0 0 0 0 0 9 h 1\n"
      "FLASER 2 5 5 0 0 0 0 0 0 9.5 h 1\n");
  EXPECT_EQ(log.scans.size(), 3u);
  ASSERT_EQ(log.summary.warnings.size(), 1u);
  EXPECT_EQ(to_string(log.summary.warnings[0]), "line 2: scan stamped earlier than the one before");
}

TEST(Carmen, AHostileCountAllocatesNothing) {
  const std::string readings =
      "line 2: FLASER line skipped: expected as many range readings as num_readings says";
  EXPECT_EQ(warning_of("FLASER 4000000000 1 2 3\n"), readings);
  EXPECT_EQ(warning_of("FLASER 1e300 1 2 3\n"), readings);
  EXPECT_EQ(warning_of("ROBOTLASER1 0 0 0 1 80 0 0 1 5 99999999999 0 0 0 0 0 0 0\n"),
            "line 2: ROBOTLASER1 line skipped: expected as many remissions as num_remissions says");
}

TEST(Carmen, NothingUsableIsOneError) {
  using namespace std::string_view_literals;
  const std::string none = "no usable laser scan; expected FLASER, RLASER or ROBOTLASER1 lines";
  EXPECT_EQ(error_of(""), "log.clf: the file is empty");
  EXPECT_EQ(error_of("# only a comment\n"), "log.clf: " + none);
  EXPECT_EQ(error_of("\nFLASER 4 1 2\n"),
            "log.clf:2: " + none +
                "; FLASER line skipped: expected as many range readings as num_readings says");
  EXPECT_EQ(error_of("ROBOTLASER0 1 2\nROBOTLASERx 1\n"), "log.clf: " + none);
  EXPECT_EQ(error_of("FLASER 4\n\0\1\2"sv),
            "log.clf:2: expected a text file (UTF-8), found binary data");
}

TEST(Carmen, FilesAndTextsReadAlike) {
  std::string text = "\xef\xbb\xbf# log\r\n";
  for (int i = 0; i < 20000; ++i) text += kFlaser + "ODOM 1 2 3 0 0 0 10 host 1\r\n";
  text += flaser_of(7);
  text.pop_back();  // the last line has no end
  const test::ScratchFolder folder;
  const auto from_file = read_log(folder.write("log.clf", text));
  ASSERT_TRUE(from_file) << to_string(from_file.error());
  const Log from_text = log_of(text);
  ASSERT_EQ(from_file->scans.size(), 20001u);
  ASSERT_EQ(from_text.scans.size(), 20001u);
  EXPECT_EQ(from_file->scans.back().scan.ranges.size(), 7u);
  EXPECT_EQ(from_file->scans.back().line, from_text.scans.back().line);
  EXPECT_EQ(from_file->odometry.size(), from_text.odometry.size());
  EXPECT_EQ(from_file->summary.lines, from_text.summary.lines);
}

TEST(Carmen, StreamsTheSameMessages) {
  const test::ScratchFolder folder;
  const std::string path =
      folder.write("log.clf", kFlaser + "ODOM 1 2 3 0 0 0 10 host 1\nTRUEPOS 1 2 3 0 0 0 10 h 1\n");
  std::vector<std::size_t> kinds;
  CarmenReader reader;
  ASSERT_TRUE(
      stream_log(path, reader, [&](LogMessage&& message) { kinds.push_back(message.index()); }));
  EXPECT_EQ(kinds, (std::vector<std::size_t>{1, 2, 3}));
  EXPECT_EQ(reader.summary().scans(), 1);
}

TEST(Carmen, FilesThatCannotBeReadAreErrors) {
  const test::ScratchFolder folder;
  EXPECT_EQ(to_string(read_log(folder.path("no.clf")).error()),
            folder.path("no.clf") + ": cannot open: No such file or directory");
  EXPECT_EQ(read_log(folder.path(".")).error().message, "expected a file, not a directory");
  EXPECT_EQ(read_log(folder.write("empty", "")).error().message, "the file is empty");
  EXPECT_EQ(read_log(folder.write("binary", std::string("\x7f"
                                                        "ELF\0\0\n",
                                                        7)))
                .error()
                .message,
            "expected a CARMEN log, found binary data");
}

TEST(Carmen, TheStepOfTheRangesIsFound) {
  std::string text;
  for (int i = 0; i < 100; ++i)
    text += "FLASER 2 " + std::to_string(i) + ".2 3.40 0 0 0 0 0 0 1 host 1\n";
  EXPECT_NEAR(find_range_step(log_of(text), {LaserKind::flaser, 1}).value_or(0.0), 0.2, 1e-12);
  EXPECT_FALSE(find_range_step(log_of(text), {LaserKind::rlaser, 1}));
  text += "FLASER 2 1.23456 3.40 0 0 0 0 0 0 1 host 1\n";
  EXPECT_EQ(find_range_step(log_of(text), {LaserKind::flaser, 1}), 0.0);
}

TEST(Carmen, AFewRangesShowNoStep) {
  const LaserId laser{LaserKind::flaser, 1};
  EXPECT_FALSE(find_range_step(log_of("FLASER 2 1.2 3.4 0 0 0 0 0 0 1 host 1\n"), laser));
  EXPECT_FALSE(find_range_step(log_of("FLASER 2 1.23456 3.4 0 0 0 0 0 0 1 host 1\n"), laser));
}

TEST(Carmen, ReadingsBeyondAllScannersAreNoReturnAndNoMaximum) {
  const Log log = log_of("FLASER 4 3.5 1.1e8 90.25 700 0 0 0 0 0 0 1 host 1\n");
  const LaserScan& scan = log.scans.at(0).scan;
  EXPECT_GT(scan.max_range, 90.25);
  EXPECT_LT(scan.max_range, 100.0);
  EXPECT_TRUE(scan.has_return(2));
  EXPECT_FALSE(scan.has_return(1));
  EXPECT_FALSE(scan.has_return(3));
  const Log far = log_of("FLASER 3 3.5 655.3 655.4 0 0 0 0 0 0 1 host 1\n");
  EXPECT_TRUE(far.scans.at(0).scan.has_return(1));
  EXPECT_FALSE(far.scans.at(0).scan.has_return(2));
}

Log random_log() {
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> number(-1.0, 1.0);
  Log log;
  for (int i = 0; i < 50; ++i) {
    LogScan entry;
    entry.scan.stamp = 1e9 + 0.1 * i;
    entry.scan.first_bearing = kPi * number(random);
    entry.scan.bearing_step = i % 2 == 0 ? kTwoPi / 150 : -0.25 * kPi / 180;
    entry.scan.max_range = 50.0;
    entry.scan.vehicle_from_laser = {number(random), number(random), kPi * number(random)};
    entry.odom_from_vehicle = {1e3 * number(random), 1e3 * number(random), kPi * number(random)};
    entry.accuracy_m = 0.1;
    for (int beam = 0; beam < 100 + i; ++beam)
      entry.scan.ranges.push_back(30.0 + 25.0 * number(random));
    log.scans.push_back(entry);
    log.odometry.push_back({1e9 + 0.1 * i + 0.05, {number(random), number(random), 1.0}});
    log.true_poses.push_back({1e9 + 0.1 * i, {number(random), number(random), -1.0}});
  }
  return log;
}

TEST(Carmen, WrittenLogsReadBack) {
  const Log log = random_log();
  const test::ScratchFolder folder;
  ASSERT_TRUE(write_carmen(log, folder.path("log.clf")));
  const auto read = read_log(folder.path("log.clf"));
  ASSERT_TRUE(read) << to_string(read.error());
  EXPECT_TRUE(read->summary.warnings.empty());
  ASSERT_EQ(read->scans.size(), log.scans.size());
  for (std::size_t i = 0; i < log.scans.size(); ++i) {
    const LogScan& a = log.scans[i];
    const LogScan& b = read->scans[i];
    EXPECT_EQ(a.scan.stamp, b.scan.stamp);
    EXPECT_EQ(a.scan.first_bearing, b.scan.first_bearing);
    EXPECT_EQ(a.scan.bearing_step, b.scan.bearing_step);
    EXPECT_EQ(a.scan.max_range, b.scan.max_range);
    EXPECT_EQ(a.scan.ranges, b.scan.ranges);
    EXPECT_EQ(a.accuracy_m, b.accuracy_m);
    EXPECT_EQ(a.odom_from_vehicle.vector(), b.odom_from_vehicle.vector());
    const Pose2 difference = inverse(a.scan.vehicle_from_laser) * b.scan.vehicle_from_laser;
    EXPECT_LT(difference.vector().norm(), 1e-11);
  }
  ASSERT_EQ(read->odometry.size(), log.odometry.size());
  ASSERT_EQ(read->true_poses.size(), log.true_poses.size());
  for (std::size_t i = 0; i < log.odometry.size(); ++i) {
    EXPECT_EQ(log.odometry[i].pose.vector(), read->odometry[i].pose.vector());
    EXPECT_EQ(log.odometry[i].stamp, read->odometry[i].stamp);
    EXPECT_EQ(log.true_poses[i].pose.vector(), read->true_poses[i].pose.vector());
  }
}

TEST(Carmen, NoReturnsStayNoReturns) {
  Log log = random_log();
  log.scans.resize(1);
  log.scans[0].scan.ranges = {1.0, std::nan(""), std::numeric_limits<double>::infinity(), 50.0,
                              0.0};
  const Log read = log_of(format_carmen(log));
  for (std::size_t beam = 0; beam < 5; ++beam)
    EXPECT_EQ(read.scans[0].scan.has_return(beam), log.scans[0].scan.has_return(beam)) << beam;
}

TEST(Carmen, NeverWritesPosesThatAreNotFinite) {
  const test::ScratchFolder folder;
  Log log = random_log();
  log.scans[7].odom_from_vehicle.theta = std::nan("");
  EXPECT_FALSE(write_carmen(log, folder.path("log.clf")));
  EXPECT_EQ(folder.files(), 0);
}

}  // namespace
}  // namespace adit
