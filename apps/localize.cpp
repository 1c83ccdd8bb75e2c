#include <fmt/core.h>

#include <optional>

#include "adit/calibration/log_settings.hpp"
#include "adit/config/enum_names.hpp"
#include "adit/io/json.hpp"
#include "adit/io/plan.hpp"
#include "adit/io/trajectory.hpp"
#include "commands.hpp"
#include "configured.hpp"
#include "localize_report.hpp"
#include "output_folder.hpp"
#include "parse_pose.hpp"
#include "replay.hpp"
#include "report_error.hpp"

namespace adit {
namespace {

struct Inputs {
  Plan plan;
  Log log;
  LoadedConfiguration configuration;
};

Result<Inputs> read_inputs(const LocalizeArguments& arguments) {
  Inputs inputs;
  Result<LoadedConfiguration> configuration = load_configuration(arguments.config);
  if (!configuration) return tl::unexpected(configuration.error());
  inputs.configuration = std::move(*configuration);
  Result<Plan> plan = read_plan(arguments.map);
  if (!plan) return tl::unexpected(plan.error());
  inputs.plan = std::move(*plan);
  Result<Log> log = read_log(arguments.log, log_options(inputs.configuration));
  if (!log) return tl::unexpected(log.error());
  inputs.log = std::move(*log);
  return inputs;
}

Result<void> write_results(const std::string& folder, const Replay& replay, const Json& report,
                           const Json& timings) {
  std::vector<StampedPose> trajectory;
  for (const EstimateRow& row : replay.rows) trajectory.push_back({row.stamp, row.pose});
  using Path = const std::string&;
  return write_all(
      folder, {{"trajectory.tum", [&](Path path) { return write_trajectory(trajectory, path); }},
               {"estimates.csv", [&](Path path) { return write_estimates(replay.rows, path); }},
               {"report.json", [&](Path path) { return write_json(report, path); }},
               {"timings.json", [&](Path path) { return write_json(timings, path); }}});
}

}  // namespace

std::vector<std::string> estimator_names() {
  std::vector<std::string> names;
  for (const auto& entry : EnumNames<Estimator>::values) names.emplace_back(entry.first);
  return names;
}

int run_localize(const LocalizeArguments& arguments) {
  const auto estimator = value_named<Estimator>(arguments.estimator);
  if (!estimator) return report({"no estimator '" + arguments.estimator + "'", {}}, kWrongCall);
  std::optional<Pose2> start;
  if (arguments.start) {
    const Result<Pose2> pose = parse_pose(*arguments.start);
    if (!pose) return report(pose.error(), kWrongCall);
    start = *pose;
  }
  Result<Inputs> inputs = read_inputs(arguments);
  if (!inputs) return report(inputs.error());

  inputs->configuration.values.localizer.estimator = *estimator;
  const LogSettings settings = settle(inputs->configuration, inputs->log);
  MapReport cleaning;
  const LineMap map = LineMap::build(inputs->plan.segments, settings.configuration.map, &cleaning);
  const Replay result = replay(inputs->log, map, settings.configuration.localizer, start);

  const Json report_json = localize_report(settings, cleaning, inputs->log.summary, result);
  if (const auto written =
          write_results(arguments.output, result, report_json, timings_report(result.timings));
      !written) {
    return report(written.error());
  }
  fmt::print("{}", localize_summary(result));
  fmt::print("wrote trajectory.tum, estimates.csv, report.json, timings.json to {}\n",
             arguments.output);
  return kDone;
}

}  // namespace adit
