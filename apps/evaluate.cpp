#include <fmt/core.h>

#include "adit/io/estimates.hpp"
#include "adit/io/relations.hpp"
#include "adit/io/trajectory.hpp"
#include "commands.hpp"
#include "report_error.hpp"
#include "reports.hpp"

namespace adit {
namespace {

Result<std::vector<EstimateSample>> read_samples(const std::string& path) {
  if (!path.ends_with(".csv"))
    return read_trajectory(path).map(
        [](const auto& poses) { return samples_of(std::span<const StampedPose>(poses)); });
  return read_estimates(path).map([](const std::vector<EstimateRow>& rows) {
    std::vector<EstimateSample> samples;
    for (const EstimateRow& row : rows) {
      samples.push_back({row.stamp, row.pose, row.covariance, row.status, row.protection_m});
    }
    return samples;
  });
}

Result<std::vector<Relation>> read_relation_list(const std::string& path) {
  return read_relations(path).map([](const std::vector<PoseRelation>& rows) {
    std::vector<Relation> relations;
    for (const PoseRelation& row : rows) {
      relations.push_back({row.from_stamp, row.to_stamp, row.from_to});
    }
    return relations;
  });
}

}  // namespace

int run_evaluate(const EvaluateArguments& arguments) {
  if (arguments.truth.empty() && arguments.relations.empty()) {
    return report({"nothing to judge by: give --truth or --relations", {}}, kWrongCall);
  }
  const auto estimates = read_samples(arguments.estimate);
  if (!estimates) return report(estimates.error());
  std::vector<StampedPose> truth;
  if (!arguments.truth.empty()) {
    auto read = read_trajectory(arguments.truth);
    if (!read) return report(read.error());
    truth = std::move(*read);
  }
  std::vector<Relation> relations;
  if (!arguments.relations.empty()) {
    auto read = read_relation_list(arguments.relations);
    if (!read) return report(read.error());
    relations = std::move(*read);
  }
  const EvaluationReport result =
      evaluate({.estimates = *estimates, .truth = truth, .relations = relations});
  fmt::print("{}", arguments.json ? evaluation_report(result).to_text() + "\n" : to_text(result));
  return kDone;
}

}  // namespace adit
