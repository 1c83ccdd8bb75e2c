// The paper's run, over a few seeds that no tuning has seen; bench/estimator_trials has many.
#include <gtest/gtest.h>

#include <algorithm>

#include "adit/evaluation/report.hpp"
#include "support/mockup_run.hpp"

namespace adit {
namespace {

constexpr std::uint64_t kFirstSeed = 31000;
constexpr int kRuns = 25;
constexpr int kClutter = 8;

struct Outcome {
  EvaluationReport report;
  int most_calls = 0;
};

const std::vector<Recording>& recordings() {
  static const std::vector<Recording> all = [] {
    std::vector<Recording> made;
    for (std::uint64_t k = 0; k < kRuns; ++k) {
      made.push_back(test::record_mockup(kFirstSeed + k, kClutter));
    }
    return made;
  }();
  return all;
}

Outcome localise(const LocalizerSettings& settings) {
  const LineMap map = LineMap::build(mockup().plan);
  Outcome outcome;
  std::vector<EstimateSample> estimates;
  std::vector<StampedPose> truth;
  for (const Recording& recording : recordings()) {
    // Stamps of different runs must not join.
    const double offset = 1e4 * static_cast<double>(truth.size());
    Localizer localizer(map, settings);
    localizer.start(recording.first_guess.pose, recording.first_guess.covariance);
    for (std::size_t i = 0; i < recording.scans.size(); ++i) {
      const Estimate& e = localizer.update(recording.scans[i], recording.odometry[i]);
      estimates.push_back({e.stamp + offset, e.pose, e.covariance, e.status, e.protection_m});
      truth.push_back({recording.truth[i].stamp + offset, recording.truth[i].pose});
      outcome.most_calls = std::max(outcome.most_calls, localizer.last_turn().match.calls);
    }
  }
  outcome.report = evaluate({.estimates = estimates, .truth = truth, .relations = {}});
  return outcome;
}

double share_ok(const EvaluationReport& report) {
  return static_cast<double>(report.by_status->ok) / static_cast<double>(report.estimates);
}

TEST(MockupStatistics, MeetsTheTargets) {
  const auto [report, most_calls] = localise(test::mockup_settings());
  SCOPED_TRACE(to_text(report));
  EXPECT_EQ(report.joined, 16 * kRuns);
  EXPECT_LE(report.position.mean, 0.04);
  EXPECT_LE(report.position.max, 0.25);
  EXPECT_LE(report.heading_deg.mean, 0.3);
  EXPECT_EQ(report.beyond_lost, 0);
  EXPECT_EQ(report.confidently_wrong, 0);
  EXPECT_GE(share_ok(report), 0.98);
  ASSERT_TRUE(report.nees);
  EXPECT_GE(report.nees->per_dof, 0.7);
  EXPECT_LE(report.nees->per_dof, 1.5);
  EXPECT_GE(report.nees->coverage_95, 0.88);
  EXPECT_LE(report.nees->coverage_95, 0.98);
  EXPECT_LT(most_calls, 250);  // what the paper reports of its search
}

TEST(MockupStatistics, TheConsistencyOfThePaperWorks) {
  LocalizerSettings settings = test::mockup_settings();
  settings.matching.consistency = Consistency::paper;
  const EvaluationReport report = localise(settings).report;
  SCOPED_TRACE(to_text(report));
  EXPECT_LE(report.position.mean, 0.1);
  EXPECT_EQ(report.beyond_lost, 0);
  EXPECT_GE(share_ok(report), 0.95);
}

TEST(MockupStatistics, TheWeightingOfThePaperWorks) {
  LocalizerSettings settings = test::mockup_settings();
  settings.estimation.weighting = Weighting::points;
  const EvaluationReport report = localise(settings).report;
  SCOPED_TRACE(to_text(report));
  EXPECT_LE(report.position.mean, 0.1);
  EXPECT_LE(report.heading_deg.mean, 0.6);
  EXPECT_EQ(report.beyond_lost, 0);
  EXPECT_GE(share_ok(report), 0.95);
}

}  // namespace
}  // namespace adit
