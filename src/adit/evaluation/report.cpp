#include "adit/evaluation/report.hpp"

#include <cmath>
#include <limits>
#include <vector>

namespace adit {
namespace {

constexpr double kInfinite = std::numeric_limits<double>::infinity();

/// A row of the run beside the truth at its stamp.
struct JoinedRow {
  const EstimateSample* sample = nullptr;
  Vector3d error = Vector3d::Constant(kInfinite);  ///< estimate minus truth, map axes
  double position_m = kInfinite;
  double heading_rad = kInfinite;
};

JoinedRow compare(const EstimateSample& sample, const Pose2& truth) {
  JoinedRow row;
  row.sample = &sample;
  if (!sample.pose.is_finite()) return row;
  row.error = {sample.pose.x - truth.x, sample.pose.y - truth.y,
               angle_between(truth.theta, sample.pose.theta)};
  row.position_m = row.error.head<2>().norm();
  row.heading_rad = std::abs(row.error.z());
  return row;
}

std::vector<JoinedRow> join(const EvaluationInput& input, const EvaluationOptions& options,
                            EvaluationReport& report) {
  std::vector<double> truth_stamps;
  for (const StampedPose& truth : input.truth) {
    truth_stamps.push_back(truth.pose.is_finite() ? truth.stamp : Statistics::kNone);
  }
  const std::vector<double> row_stamps = stamps_of(input.estimates);
  const StampIndex truth_index(truth_stamps);
  const StampIndex row_index(row_stamps);
  const double tolerance = options.join_tolerance_s;

  std::vector<JoinedRow> rows;
  for (const EstimateSample& sample : input.estimates) {
    const auto match = truth_index.nearest(sample.stamp, tolerance);
    if (!match) continue;
    const double stamp = truth_stamps[*match];
    const std::size_t closest = row_index.nearest(stamp, tolerance).value();
    if (std::abs(row_stamps[closest] - stamp) < std::abs(sample.stamp - stamp)) continue;
    rows.push_back(compare(sample, input.truth[*match].pose));
  }
  for (const double stamp : truth_stamps) {
    if (!row_index.nearest(stamp, tolerance)) ++report.missing;
  }
  report.joined = static_cast<std::int64_t>(rows.size());
  report.without_truth = report.estimates - report.joined;
  return rows;
}

void judge_errors(std::span<const JoinedRow> rows, const EvaluationOptions& options,
                  EvaluationReport& report) {
  std::vector<double> position;
  std::vector<double> heading_deg;
  for (const JoinedRow& row : rows) {
    position.push_back(row.position_m);
    heading_deg.push_back(degrees(row.heading_rad));
    if (!row.error.allFinite()) ++report.not_finite;
    if (row.position_m <= options.lost_position_m && row.heading_rad <= options.lost_heading_rad) {
      continue;
    }
    ++report.beyond_lost;
    if (!report.first_lost_stamp) report.first_lost_stamp = row.sample->stamp;
    if (row.sample->status == Status::ok) ++report.confidently_wrong;
  }
  report.position = summarise(std::move(position));
  report.heading_deg = summarise(std::move(heading_deg));
}

void judge_claims(std::span<const JoinedRow> rows, EvaluationReport& report) {
  std::vector<ClaimedError> all;
  std::vector<ClaimedError> ok;
  std::vector<double> levels;
  ProtectionCheck protection;
  bool has_protection = false;
  for (const JoinedRow& row : rows) {
    const EstimateSample& sample = *row.sample;
    if (sample.covariance) {
      all.push_back({row.error, *sample.covariance});
      if (sample.status == Status::ok) ok.push_back(all.back());
    }
    if (!sample.protection_m) continue;
    has_protection = true;
    if (!std::isfinite(*sample.protection_m)) continue;
    levels.push_back(*sample.protection_m);
    if (row.position_m > *sample.protection_m) ++protection.exceeded;
  }
  if (!all.empty()) report.nees = judge_consistency(all);
  if (!ok.empty()) report.nees_ok = judge_consistency(ok);
  if (has_protection) {
    protection.level = summarise(std::move(levels));
    protection.count = protection.level.count;
    report.protection = protection;
  }
}

}  // namespace

EvaluationReport evaluate(const EvaluationInput& input, const EvaluationOptions& options) {
  EvaluationReport report;
  report.estimates = static_cast<std::int64_t>(input.estimates.size());
  report.truth = static_cast<std::int64_t>(input.truth.size());
  for (const EstimateSample& sample : input.estimates) {
    if (!sample.status) continue;
    if (!report.by_status) report.by_status.emplace();
    ++(*report.by_status)[*sample.status];
  }
  const std::vector<JoinedRow> rows = join(input, options, report);
  judge_errors(rows, options, report);
  judge_claims(rows, report);
  if (!input.relations.empty()) {
    report.relations = relations_metric(input.estimates, input.relations, options.join_tolerance_s);
  }
  return report;
}

}  // namespace adit
