// The whole way from real logs to estimates, as the command goes it, where the data is present.
#include <gtest/gtest.h>

#include <algorithm>

#include "adit/calibration/log_settings.hpp"
#include "adit/evaluation/report.hpp"
#include "adit/extraction/extraction.hpp"
#include "adit/io/carmen.hpp"
#include "adit/io/plan.hpp"
#include "adit/io/trajectory.hpp"
#include "apps/replay.hpp"
#include "support/test_files.hpp"

namespace adit {
namespace {

template <class T>
T value_of(Result<T> result) {
  EXPECT_TRUE(result) << to_string(result.error());
  return result ? std::move(*result) : T{};
}

Replay localise(const std::string& log_path, const std::vector<Segment>& plan,
                const std::optional<Pose2>& start) {
  const Log log = value_of(read_log(log_path));
  const LogSettings settings = settle({}, log);
  const LineMap map = LineMap::build(plan, settings.configuration.map);
  Replay result =
      replay(log, map, settings.configuration.localizer, {false, start, std::nullopt}, nullptr);
  EXPECT_EQ(result.rows.size(), log.scans.size());
  for (std::size_t i = 0; i < std::min(result.rows.size(), log.scans.size()); ++i) {
    const EstimateRow& row = result.rows[i];
    EXPECT_EQ(row.stamp, log.scans[i].scan.stamp);
    EXPECT_TRUE(row.pose.is_finite()) << i;
    EXPECT_TRUE(row.covariance.allFinite()) << i;
    EXPECT_GT(row.covariance.diagonal().minCoeff(), 0.0) << i;
    if (::testing::Test::HasFailure()) break;
  }
  return result;
}

TEST(RealData, IntelIsLocalisedOnItsPlan) {
  ADIT_DATA_FILE(log_path, "intel/log.clf");
  ADIT_DATA_FILE(plan_path, "intel/map.csv");
  ADIT_DATA_FILE(reference_path, "intel/reference.tum");
  const Plan plan = value_of(read_plan(plan_path));
  const Pose2 start{4.78, -5.84, radians(-96.83)};
  const Replay result = localise(log_path, plan.segments, start);
  EXPECT_EQ(result.rows.size(), 10090u);

  std::vector<EstimateSample> samples;
  for (const EstimateRow& row : result.rows) {
    samples.push_back({row.stamp, row.pose, row.covariance, row.status, row.protection_m});
  }
  const std::vector<StampedPose> reference = value_of(read_trajectory(reference_path));
  const EvaluationReport report =
      evaluate({.estimates = samples, .truth = reference, .relations = {}});
  SCOPED_TRACE(to_text(report));
  EXPECT_EQ(report.truth, 2672);
  EXPECT_EQ(report.missing, 0);
  EXPECT_LE(report.position.mean, 0.10);
  EXPECT_LT(report.position.max, 1.0);
  EXPECT_EQ(report.beyond_lost, 0);
}

// No plan of this building is at hand. One that has nothing to do with it must not be believed.
TEST(RealData, FrClinicIsAnsweredScanByScan) {
  ADIT_DATA_FILE(log_path, "fr-clinic/log.clf");
  const std::vector<Segment> square = {{{-60, -60}, {60, -60}},
                                       {{60, -60}, {60, 60}},
                                       {{60, 60}, {-60, 60}},
                                       {{-60, 60}, {-60, -60}}};
  const Replay result = localise(log_path, square, std::nullopt);
  EXPECT_EQ(result.rows.size(), 1500u);
  const auto believed = std::count_if(result.rows.begin(), result.rows.end(),
                                      [](const auto& row) { return row.status == Status::ok; });
  EXPECT_LT(believed, 75);
}

TEST(RealData, ProfilesOfAMineHaveFeatures) {
  for (const char* name :
       {"chilean_mine/11S.clf", "chilean_mine/19S.clf", "chilean_mine/25S.clf"}) {
    SCOPED_TRACE(name);
    ADIT_DATA_FILE(path, name);
    const Log log = value_of(read_log(path));
    const LocalizerSettings settings = settle({}, log).configuration.localizer;
    ASSERT_EQ(log.scans.size(), 1u);
    Extractor extractor;
    const FeatureList& features =
        extractor.extract(log.scans[0].scan, settings.scanner, settings.extraction);
    EXPECT_GE(features.lines.size(), 4u);
    EXPECT_LE(features.lines.size(), 60u);
    EXPECT_GE(features.corners.size(), 1u);
    double length = 0.0;
    for (const Line& line : features.lines) {
      EXPECT_GE(line.length(), settings.extraction.min_line_m);
      EXPECT_GE(line.points, settings.extraction.min_line_points);
      length += line.length();
    }
    EXPECT_GT(length, 15.0);
  }
}

}  // namespace
}  // namespace adit
