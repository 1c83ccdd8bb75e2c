#include <fmt/core.h>

#include <cmath>
#include <optional>

#include "adit/calibration/log_settings.hpp"
#include "adit/config/enum_names.hpp"
#include "adit/io/json.hpp"
#include "adit/io/plan_levels.hpp"
#include "adit/io/saved_pose.hpp"
#include "adit/io/trajectory.hpp"
#include "adit/threads/share_out.hpp"
#include "commands.hpp"
#include "configured.hpp"
#include "find_level.hpp"
#include "localize_report.hpp"
#include "localize_start.hpp"
#include "mine_levels.hpp"
#include "output_folder.hpp"
#include "replay.hpp"
#include "report_error.hpp"

namespace adit {
namespace {

constexpr std::size_t kScansForLevel = 200;  // are asked for the level that they are on

struct Inputs {
  std::vector<PlanLevel> plans;
  Log log;
  LoadedConfiguration configuration;
};

/// The map of the run: a level of the plan, and its index where that is needed at once.
struct RunMap {
  std::string level;
  MapReport cleaning;
  LineMap map;
  std::shared_ptr<const PlaceIndex> places;
};

Result<Inputs> read_inputs(const LocalizeArguments& arguments) {
  Inputs inputs;
  Result<LoadedConfiguration> configuration = load_configuration(arguments.config);
  if (!configuration) return tl::unexpected(configuration.error());
  inputs.configuration = std::move(*configuration);
  Result<std::vector<PlanLevel>> plans = read_plan_levels(arguments.map);
  if (!plans) return tl::unexpected(plans.error());
  inputs.plans = std::move(*plans);
  Result<Log> log = read_log(arguments.log, log_options(inputs.configuration));
  if (!log) return tl::unexpected(log.error());
  inputs.log = std::move(*log);
  return inputs;
}

/// The level named, else that on which the first scans lie.
Result<RunMap> make_map(const Inputs& inputs, const Start& start,
                        const Configuration& configuration, const LocalizeArguments& arguments) {
  const auto named = level_of(inputs.plans, start);
  if (!named) return tl::unexpected(named.error());
  const IndexSettings index{configuration.localizer.places,
                            threads_or_cores(arguments.threads.value_or(0)), arguments.index};
  std::optional<std::size_t> level = *named;
  RunMap run;
  if (!level) {
    const auto levels = prepare_levels(inputs.plans, configuration.map, index);
    if (!levels) return tl::unexpected(levels.error());
    level = find_level(inputs.log, *levels, configuration.localizer, kScansForLevel);
    if (!level) {
      return fail("no scan says on which level it is; name one of " + names_of(inputs.plans) +
                      " with --level",
                  arguments.log);
    }
    run.places = (*levels)[*level].places;
  }
  const PlanLevel& plan = inputs.plans[*level];
  run.level = plan.name;
  run.map = LineMap::build(plan.plan.segments, configuration.map, &run.cleaning);
  if ((start.beginning.is_anywhere || !arguments.index.empty()) && !run.places) {
    auto places = index_of(run.map, index, plan.name);
    if (!places) return tl::unexpected(places.error());
    run.places = std::move(*places);
  }
  return run;
}

SavedPose last_pose(const Replay& replay, const std::string& level) {
  const EstimateRow& last = replay.rows.back();
  return {last.stamp, last.pose, last.covariance, last.status, level};
}

/// The poses that are known to some extent: the form has no word for others.
std::vector<StampedPose> known_poses(const Replay& replay) {
  std::vector<StampedPose> trajectory;
  for (const EstimateRow& row : replay.rows) {
    const bool is_unknown = !std::isfinite(row.covariance.trace());
    if (!is_unknown) trajectory.push_back({row.stamp, row.pose});
  }
  return trajectory;
}

Result<void> write_results(const std::string& folder, const Replay& replay, const SavedPose& last,
                           const Json& report, const Json& timings) {
  using Path = const std::string&;
  return write_all(
      folder,
      {{"trajectory.tum", [&](Path path) { return write_trajectory(known_poses(replay), path); }},
       {"estimates.csv", [&](Path path) { return write_estimates(replay.rows, path); }},
       {"last_pose.json", [&](Path path) { return write_saved_pose(last, path); }},
       {"report.json", [&](Path path) { return write_json(report, path); }},
       {"timings.json", [&](Path path) { return write_json(timings, path); }}});
}

/// What is wrong with the call before any file is read.
Result<Estimator> estimator_of(const LocalizeArguments& arguments) {
  const auto estimator = value_named<Estimator>(arguments.estimator);
  if (!estimator) return fail("no estimator '" + arguments.estimator + "'");
  return *estimator;
}

/// A start without a pose is only of use to who searches the mine.
Result<void> check_start(const Start& start, const LocalizerSettings& settings) {
  if (!start.beginning.is_anywhere) return {};
  if (settings.estimator == Estimator::features) {
    return fail("a start anywhere needs --estimator full or points: features alone find no pose");
  }
  if (!settings.recovery.searches) {
    return fail("a start anywhere needs [recovery] searches = true");
  }
  return {};
}

int fail_with(const Error& error) {
  return report(error, error.file.empty() ? kWrongCall : kFailed);
}

}  // namespace

std::vector<std::string> estimator_names() {
  std::vector<std::string> names;
  for (const auto& entry : EnumNames<Estimator>::values) names.emplace_back(entry.first);
  return names;
}

int run_localize(const LocalizeArguments& arguments) {
  const Result<Estimator> estimator = estimator_of(arguments);
  if (!estimator) return report(estimator.error(), kWrongCall);
  const Result<Start> start = start_of(arguments);
  if (!start) return fail_with(start.error());
  Result<Inputs> inputs = read_inputs(arguments);
  if (!inputs) return report(inputs.error());

  inputs->configuration.values.localizer.estimator = *estimator;
  const LogSettings settings = settle(inputs->configuration, inputs->log);
  const LocalizerSettings& values = settings.configuration.localizer;
  if (const auto checked = check_start(*start, values); !checked) return fail_with(checked.error());
  const Result<RunMap> run = make_map(*inputs, *start, settings.configuration, arguments);
  if (!run) return fail_with(run.error());
  const Replay result = replay(inputs->log, run->map, values, start->beginning, run->places);

  const RunOrigin origin{start->source, run->level};
  const Json report_json =
      localize_report(settings, run->cleaning, inputs->log.summary, origin, result);
  if (const auto written = write_results(arguments.output, result, last_pose(result, run->level),
                                         report_json, timings_report(result.timings));
      !written) {
    return report(written.error());
  }
  fmt::print("{}", localize_summary(result));
  fmt::print(
      "wrote trajectory.tum, estimates.csv, last_pose.json, report.json, timings.json to {}\n",
      arguments.output);
  return kDone;
}

}  // namespace adit
