#include "adit/evaluation/report.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <vector>

namespace adit {
namespace {

constexpr double kInfinite = std::numeric_limits<double>::infinity();
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

std::vector<EstimateSample> bare(const std::vector<StampedPose>& trajectory) {
  return samples_of(std::span<const StampedPose>(trajectory));
}

EstimateSample full_row(double stamp, const Pose2& pose, Status status, double protection_m) {
  return {stamp, pose, Matrix3d(Vector3d(0.01, 0.01, 1e-4).asDiagonal()), status, protection_m};
}

TEST(Evaluate, HandComputedErrors) {
  const std::vector<StampedPose> truth = {
      {1.0, {0, 0, 0}}, {2.0, {10, 0, kPi}}, {3.0, {20, 0, 0}}, {4.0, {30, 0, 0}}};
  const auto run = bare({{1.0004, {0.3, 0.4, radians(2.0)}},       // 0.5 m, 2 degrees
                         {2.0, {10.0, -0.1, radians(-176.0)}},     // 0.1 m, 4 degrees across pi
                         {2.5, {99.0, 99.0, 1.0}},                 // no truth
                         {2.9995, {20.0, 0.0, radians(-12.0)}}});  // 0 m, 12 degrees
  const EvaluationReport report = evaluate({run, truth, {}});
  EXPECT_EQ(report.estimates, 4);
  EXPECT_EQ(report.truth, 4);
  EXPECT_EQ(report.joined, 3);
  EXPECT_EQ(report.without_truth, 1);
  EXPECT_EQ(report.missing, 1);
  EXPECT_NEAR(report.position.mean, 0.2, 1e-12);
  EXPECT_NEAR(report.position.rms, std::sqrt(0.26 / 3.0), 1e-12);
  EXPECT_NEAR(report.position.median, 0.1, 1e-12);
  EXPECT_NEAR(report.position.max, 0.5, 1e-12);
  EXPECT_NEAR(report.heading_deg.mean, 6.0, 1e-9);
  EXPECT_NEAR(report.heading_deg.median, 4.0, 1e-9);
  EXPECT_NEAR(report.heading_deg.p95, 12.0, 1e-9);
  EXPECT_EQ(report.beyond_lost, 0);
  EXPECT_FALSE(report.first_lost_stamp);
  EXPECT_FALSE(report.by_status);
  EXPECT_FALSE(report.nees);
  EXPECT_FALSE(report.protection);
  EXPECT_FALSE(report.relations);
}

TEST(Evaluate, RepeatedAndBackwardStampsAreAllJudged) {
  const std::vector<StampedPose> truth = {{5.0, {1, 0, 0}}, {4.0, {0, 0, 0}}, {5.0, {1, 0, 0}}};
  const auto run = bare({{5.0, {1, 0, 0}}, {4.0, {0, 0, 0}}, {5.0, {1.5, 0, 0}}});
  const EvaluationReport report = evaluate({run, truth, {}});
  EXPECT_EQ(report.joined, 3);
  EXPECT_EQ(report.missing, 0);
  EXPECT_DOUBLE_EQ(report.position.max, 0.5);
}

TEST(Evaluate, ScansOfOneMillisecondAreNotTakenForEachOther) {
  const std::vector<StampedPose> truth = {{5.0, {1, 0, 0}}, {5.0006, {1.1, 0, 0}}};
  const auto run =
      bare({{5.0009, {2, 0, 0}}, {5.0, {1, 0, 0}}, {5.0006, {1.1, 0, 0}}, {4.9992, {0.5, 0, 0}}});
  const EvaluationReport report = evaluate({run, truth, {}});
  EXPECT_EQ(report.joined, 2);
  EXPECT_EQ(report.without_truth, 2);
  EXPECT_EQ(report.missing, 0);
  EXPECT_EQ(report.position.max, 0.0);
}

TEST(Evaluate, LostIsPastEitherBoundInTheOrderOfTheLog) {
  const std::vector<StampedPose> truth = {{1.0, {}}, {2.0, {}}, {3.0, {}}, {4.0, {}}};
  const std::vector<EstimateSample> run = {
      full_row(1.0, {1.0, 0.0, 0.0}, Status::ok, kInfinite),  // at the bound is not past it
      full_row(4.0, {0.0, 0.0, radians(-20.5)}, Status::ok, kInfinite),
      full_row(3.0, {0.0, 1.01, 0.0}, Status::lost, kInfinite),
      full_row(2.0, {0.0, 0.0, radians(19.5)}, Status::ok, kInfinite)};
  const EvaluationReport report = evaluate({run, truth, {}});
  EXPECT_EQ(report.beyond_lost, 2);
  EXPECT_EQ(report.first_lost_stamp, 4.0);
  EXPECT_EQ(report.confidently_wrong, 1);
}

TEST(Evaluate, APoseWithoutNumbersIsLostAndNotForgotten) {
  const std::vector<StampedPose> truth = {{1.0, {}}, {2.0, {}}, {3.0, {kNan, 0, 0}}};
  const auto run = bare({{1.0, {}}, {2.0, {kNan, 0.0, 0.0}}, {3.0, {}}});
  const EvaluationReport report = evaluate({run, truth, {}});
  EXPECT_EQ(report.joined, 2);
  EXPECT_EQ(report.not_finite, 1);
  EXPECT_EQ(report.missing, 1);  // truth that is no pose can judge nothing
  EXPECT_EQ(report.without_truth, 1);
  EXPECT_EQ(report.first_lost_stamp, 2.0);
  EXPECT_EQ(report.position.max, kInfinite);
}

TEST(Evaluate, ClaimsOfStatusCovarianceAndProtection) {
  const std::vector<StampedPose> truth = {{1.0, {}}, {2.0, {}}, {3.0, {}}};
  const std::vector<EstimateSample> run = {
      full_row(1.0, {0.1, 0.0, 0.0}, Status::ok, 0.3),          // NEES 1
      full_row(2.0, {0.0, 0.2, 0.01}, Status::ok, 0.15),        // NEES 5, past its level
      full_row(3.0, {0.3, 0.0, 0.0}, Status::lost, kInfinite),  // NEES 9
      full_row(9.0, {}, Status::degraded, 0.2)};                // no truth
  const EvaluationReport report = evaluate({run, truth, {}});
  ASSERT_TRUE(report.by_status);
  EXPECT_EQ(report.by_status->ok, 2);
  EXPECT_EQ(report.by_status->degraded, 1);
  EXPECT_EQ(report.by_status->ambiguous, 0);
  EXPECT_EQ(report.by_status->lost, 1);
  ASSERT_TRUE(report.nees);
  EXPECT_EQ(report.nees->count, 3);
  EXPECT_NEAR(report.nees->per_dof, 15.0 / 9.0, 1e-12);
  EXPECT_NEAR(report.nees->coverage_95, 2.0 / 3.0, 1e-12);
  ASSERT_TRUE(report.nees_ok);
  EXPECT_NEAR(report.nees_ok->per_dof, 1.0, 1e-12);
  ASSERT_TRUE(report.protection);
  EXPECT_EQ(report.protection->count, 2);
  EXPECT_EQ(report.protection->exceeded, 1);
  EXPECT_NEAR(report.protection->level.mean, 0.225, 1e-12);
}

TEST(Evaluate, RelationsNeedNoTruth) {
  const auto run = bare({{1.0, {}}, {2.0, {1, 0, 0}}});
  const std::vector<Relation> relations = {{1.0, 2.0, {1.1, 0, 0}}};
  const EvaluationReport report = evaluate({run, {}, relations});
  ASSERT_TRUE(report.relations);
  EXPECT_NEAR(report.relations->translation_mean, 0.1, 1e-12);
  EXPECT_EQ(report.joined, 0);
  EXPECT_EQ(report.missing, 0);
  EXPECT_TRUE(std::isnan(report.position.mean));
}

TEST(Evaluate, SamplesOfEstimatesKeepEveryClaim) {
  Estimate estimate;
  estimate.stamp = 3.0;
  estimate.pose = {1, 2, 0.5};
  estimate.covariance = Matrix3d::Identity();
  estimate.status = Status::ambiguous;
  estimate.protection_m = 0.7;
  const std::vector<EstimateSample> rows = samples_of(std::span<const Estimate>(&estimate, 1));
  ASSERT_EQ(rows.size(), 1U);
  EXPECT_EQ(rows[0].stamp, 3.0);
  EXPECT_EQ(rows[0].pose.y, 2.0);
  EXPECT_EQ(rows[0].covariance, Matrix3d(Matrix3d::Identity()));
  EXPECT_EQ(rows[0].status, Status::ambiguous);
  EXPECT_EQ(rows[0].protection_m, 0.7);
}

TEST(ReportText, NamesWhatIsThereAndOmitsWhatIsNot) {
  const std::string empty = to_text({});
  EXPECT_NE(empty.find("0 estimates"), std::string::npos);
  EXPECT_EQ(empty.find("nan"), std::string::npos);

  const std::vector<StampedPose> truth = {{1.0, {}}, {2.0, {}}};
  const std::vector<EstimateSample> run = {full_row(1.0, {0.25, 0, 0}, Status::ok, 0.5),
                                           full_row(2.0, {2.0, 0, 0}, Status::ok, 0.5)};
  const std::vector<Relation> relations = {{1.0, 2.0, {}}};
  const std::string text = to_text(evaluate({run, truth, relations}));
  for (const char* part :
       {"2 joined", "ok 2", "position (m)", "1.1250", "heading (deg)", "first at 2.000000",
        "1 of them with status ok", "NEES", "2 levels, 1 exceeded", "1 of 1 matched", "1.7500"}) {
    EXPECT_NE(text.find(part), std::string::npos) << part << " is not in\n" << text;
  }
  EXPECT_EQ(text.back(), '\n');
}

}  // namespace
}  // namespace adit
