#include <fmt/core.h>

#include <algorithm>
#include <filesystem>

#include "adit/io/json.hpp"
#include "adit/io/plan.hpp"
#include "adit/io/trajectory.hpp"
#include "commands.hpp"
#include "parse_pose.hpp"
#include "replay.hpp"
#include "report_error.hpp"
#include "reports.hpp"

namespace adit {
namespace {

struct Inputs {
  Plan plan;
  Log log;
  LoadedConfiguration configuration;
  std::optional<Pose2> start;
};

Result<Inputs> read_inputs(const LocalizeArguments& arguments) {
  Inputs inputs;
  if (!arguments.config.empty()) {
    Result<LoadedConfiguration> configuration = read_configuration(arguments.config);
    if (!configuration) return tl::unexpected(configuration.error());
    inputs.configuration = std::move(*configuration);
  }
  LogOptions options;
  if (inputs.configuration.has("scanner.max_range_m")) {
    options.max_range_m = inputs.configuration.values.localizer.scanner.max_range_m;
  }
  Result<Plan> plan = read_plan(arguments.map);
  if (!plan) return tl::unexpected(plan.error());
  inputs.plan = std::move(*plan);
  Result<Log> log = read_log(arguments.log, options);
  if (!log) return tl::unexpected(log.error());
  inputs.log = std::move(*log);
  return inputs;
}

Result<void> write_results(const std::filesystem::path& folder, const Replay& replay,
                           const Json& report, const Json& timings) {
  std::error_code code;
  std::filesystem::create_directories(folder, code);
  if (code) return fail("cannot make the folder: " + code.message(), folder.string());
  std::vector<StampedPose> trajectory;
  for (const EstimateRow& row : replay.rows) trajectory.push_back({row.stamp, row.pose});
  return write_trajectory(trajectory, (folder / "trajectory.tum").string())
      .and_then([&] { return write_estimates(replay.rows, (folder / "estimates.csv").string()); })
      .and_then([&] { return write_json(report, (folder / "report.json").string()); })
      .and_then([&] { return write_json(timings, (folder / "timings.json").string()); });
}

}  // namespace

int run_localize(const LocalizeArguments& arguments) {
  if (arguments.estimator != "features") {
    return report(
        {"--estimator " + arguments.estimator + " is not built yet: only 'features' is there", {}},
        kWrongCall);
  }
  std::optional<Pose2> start;
  if (!arguments.start.empty()) {
    const Result<Pose2> pose = parse_pose(arguments.start);
    if (!pose) return report(pose.error(), kWrongCall);
    start = *pose;
  }
  Result<Inputs> inputs = read_inputs(arguments);
  if (!inputs) return report(inputs.error());

  const ReplaySettings settings = settle(inputs->configuration, inputs->log);
  MapReport cleaning;
  const LineMap map = LineMap::build(inputs->plan.segments, settings.configuration.map, &cleaning);
  const Replay result = replay(inputs->log, map, settings.configuration.localizer, start);

  const Json report_json =
      localize_report(arguments.estimator, settings, cleaning, inputs->log.summary, result);
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
