#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "adit/plot/figures.hpp"
#include "support/test_files.hpp"

namespace adit {
namespace {

constexpr double kInfinite = std::numeric_limits<double>::infinity();
constexpr const char* kOrangeInSvg = "rgb(90";  // its first part, in percent

const std::vector<Segment> kRoom = {
    {{0, 0}, {12, 0}}, {{12, 0}, {12, 8}}, {{12, 8}, {0, 8}}, {{0, 8}, {0, 0}}};

/// A run through the room, all of one status; `protection_m` at each pose.
std::vector<TrajectoryPoint> run_of(Status status, std::optional<double> protection_m) {
  std::vector<TrajectoryPoint> run;
  for (int i = 0; i < 40; ++i) {
    run.push_back({{1.0 + 0.2 * i, 4.0, 0.0}, std::nullopt, status, protection_m, std::nullopt});
  }
  return run;
}

class TrajectoryFigure : public ::testing::Test {
 protected:
  std::string drawn(const std::vector<TrajectoryPoint>& run) const {
    const auto done = draw_trajectory(folder_.path("run.svg"), kRoom, run);
    EXPECT_TRUE(done) << to_string(done.error());
    return test::contents_of(folder_.path("run.svg"));
  }
  std::string drawn(const Chart& chart) const {
    EXPECT_TRUE(draw_chart(folder_.path("chart.svg"), chart));
    return test::contents_of(folder_.path("chart.svg"));
  }
  static double height(const std::string& svg) {
    const std::size_t at = svg.find("height=\"");
    return at == svg.npos ? 0.0 : std::stod(svg.substr(at + 8));
  }

  test::ScratchFolder folder_;
};

TEST_F(TrajectoryFigure, TheProtectionLevelHasAChartWhereOneIsGiven) {
  const std::string with = drawn(run_of(Status::ok, 0.2));
  const std::string infinite = drawn(run_of(Status::ok, kInfinite));
  EXPECT_EQ(infinite, drawn(run_of(Status::ok, std::nullopt)));
  EXPECT_GT(height(infinite), 50.0);
  EXPECT_GT(height(with), height(infinite) + 50.0);
}

TEST_F(TrajectoryFigure, StretchesThatAreNotOkAreMarkedInTheChart) {
  std::vector<TrajectoryPoint> run = run_of(Status::ok, 0.2);
  EXPECT_EQ(drawn(run).find(kOrangeInSvg), std::string::npos);
  run[20].status = Status::degraded;
  const std::string one = drawn(run);
  // In the legend and on the way a line and a mark each, and a band in the chart; what follows one
  // another with one status is one stretch.
  const auto count = [](const std::string& text) {
    int found = 0;
    for (std::size_t at = text.find(kOrangeInSvg); at != text.npos;
         at = text.find(kOrangeInSvg, at + 1)) {
      ++found;
    }
    return found;
  };
  EXPECT_EQ(count(one), 5);
  for (std::size_t i = 18; i < 24; ++i) run[i].status = Status::degraded;
  EXPECT_EQ(count(drawn(run)), 5);
  run[21].status = Status::ok;
  EXPECT_EQ(count(drawn(run)), 7);
}

TEST_F(TrajectoryFigure, TheErrorIsDrawnWhereItIsKnown) {
  std::vector<TrajectoryPoint> run = run_of(Status::ok, 0.2);
  const std::string without = drawn(run);
  run[3].error_m = 0.01;
  run[30].error_m = 0.02;
  EXPECT_GT(drawn(run).size(), without.size());
}

TEST_F(TrajectoryFigure, BandsOfAChartStandBehindItsCurves) {
  Chart chart;
  chart.series = {{"", {{0, 1}, {10, 2}}, Stroke{}, {}}};
  EXPECT_EQ(drawn(chart).find(kOrangeInSvg), std::string::npos);
  chart.bands = {{2.0, 4.0, kOrange}};
  const std::string picture = drawn(chart);
  ASSERT_NE(picture.find(kOrangeInSvg), std::string::npos);
  EXPECT_LT(picture.find(kOrangeInSvg), picture.find("stroke-width"));
  chart.bands = {{NAN, 4.0, kOrange}, {2.0, kInfinite, kOrange}};
  EXPECT_EQ(drawn(chart).find(kOrangeInSvg), std::string::npos);
}

}  // namespace
}  // namespace adit
