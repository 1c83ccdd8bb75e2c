#include "adit/io/log_file.hpp"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <fstream>
#include <thread>

#include "support/test_files.hpp"

namespace adit {
namespace {

/// Scans of five beams, each with an ODOM message before it; the last scan alone shows what the
/// scanner says for "no return".
std::string log_text(int scans) {
  std::string text;
  for (int i = 0; i < scans; ++i) {
    const std::string stamp = std::to_string(i);
    const std::string range = i + 1 < scans ? "2.5" : "9";
    text += "ODOM " + stamp + " 0 0 0 0 0 " + stamp + " host " + stamp + "\n";
    text += "ROBOTLASER1 0 -1 2 0.5 9 0.01 0 5 1 2 3 " + range + " 4 0 " + stamp + " 0 0 " + stamp +
            " 0 0 0 0 0.3 0.3 1000 " + stamp + " host " + stamp + "\n";
  }
  return text;
}

std::vector<LogScan> scans_of(const LogFile& log) {
  std::vector<LogScan> scans;
  EXPECT_TRUE(log.visit_scans([&](const LogScan& scan) { scans.push_back(scan); }));
  return scans;
}

void expect_same(const std::vector<LogScan>& a, const std::vector<LogScan>& b) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    EXPECT_EQ(a[i].scan.stamp, b[i].scan.stamp);
    EXPECT_EQ(a[i].scan.ranges, b[i].scan.ranges);
    EXPECT_EQ(a[i].scan.max_range, b[i].scan.max_range);
    EXPECT_EQ(a[i].odom_from_vehicle.x, b[i].odom_from_vehicle.x);
    EXPECT_EQ(a[i].odometry_before, b[i].odometry_before);
  }
}

TEST(LogFile, GivesTheScansThatReadLogGivesHoweverOftenItIsAsked) {
  const test::ScratchFolder folder;
  const std::string path = folder.write("log.clf", log_text(100));
  const auto whole = read_log(path);
  ASSERT_TRUE(whole);
  for (const std::size_t most_ranges : {std::size_t{5000}, std::size_t{60}, std::size_t{1}}) {
    const auto log = LogFile::open(path, {}, most_ranges);
    ASSERT_TRUE(log);
    EXPECT_EQ(log->scans(), 100U);
    EXPECT_EQ(log->sample().odometry.size(), 100U);
    EXPECT_EQ(log->sample().summary.scans(), 100);
    expect_same(scans_of(*log), whole->scans);
    expect_same(scans_of(*log), whole->scans);
  }
}

TEST(LogFile, HoldsNoMoreThanASampleSpreadOverTheLog) {
  const test::ScratchFolder folder;
  const auto log = LogFile::open(folder.write("log.clf", log_text(100)), {}, 60);
  ASSERT_TRUE(log);
  const std::vector<LogScan>& held = log->sample().scans;
  ASSERT_GE(held.size(), 6U);
  ASSERT_LE(held.size(), 12U);
  const double step = held[1].scan.stamp - held[0].scan.stamp;
  for (std::size_t i = 1; i < held.size(); ++i) {
    EXPECT_EQ(held[i].scan.stamp - held[i - 1].scan.stamp, step);
  }
  EXPECT_GT(held.back().scan.stamp, 100.0 - 2.0 * step);
}

TEST(LogFile, HoldsScansOfEveryLaser) {
  const test::ScratchFolder folder;
  std::string text;
  for (int i = 0; i < 100; ++i) {
    const std::string end =
        " 0 0 0 0 0 0 " + std::to_string(i) + " host " + std::to_string(i) + "\n";
    text += "FLASER 4 1 2 3 4" + end + "RLASER 4 1 2 3 4" + end;
  }
  const auto log = LogFile::open(folder.write("log.clf", text), {}, 40);
  ASSERT_TRUE(log);
  std::vector<int> held(2, 0);
  for (const LogScan& scan : log->sample().scans) {
    ++held[static_cast<std::size_t>(scan.scan.scanner)];
  }
  EXPECT_GE(held[0], 2);
  EXPECT_EQ(held[0], held[1]);
  EXPECT_EQ(scans_of(*log).size(), 200U);
}

TEST(LogFile, SaysSoWhenTheLogChangedMeanwhile) {
  const test::ScratchFolder folder;
  const std::string path = folder.write("log.clf", log_text(100));
  const auto log = LogFile::open(path, {}, 60);
  ASSERT_TRUE(log);
  for (const int scans : {99, 101}) {
    folder.write("log.clf", log_text(scans));
    const auto visited = log->visit_scans([](const LogScan&) {});
    ASSERT_FALSE(visited);
    EXPECT_NE(to_string(visited.error()).find("log.clf: the log has changed"), std::string::npos);
  }
}

TEST(LogFile, KeepsAPipeWhole) {
  const test::ScratchFolder folder;
  const std::string path = folder.path("pipe");
  ASSERT_EQ(mkfifo(path.c_str(), 0600), 0);
  std::thread writer([&] { std::ofstream(path) << log_text(100); });
  const auto log = LogFile::open(path, {}, 60);
  writer.join();
  ASSERT_TRUE(log);
  EXPECT_EQ(log->sample().scans.size(), 100U);
  EXPECT_EQ(scans_of(*log).size(), 100U);
}

TEST(LogFile, CannotBeOpenedWhereALogCannotBeRead) {
  const test::ScratchFolder folder;
  EXPECT_EQ(to_string(LogFile::open(folder.path("no.clf")).error()),
            folder.path("no.clf") + ": cannot open: No such file or directory");
  EXPECT_FALSE(LogFile::open(folder.write("empty", "")));
  EXPECT_FALSE(LogFile::open(folder.write("none.clf", "ODOM 0 0 0 0 0 0 0 host 0\n")));
}

}  // namespace
}  // namespace adit
