#include <fmt/core.h>

#include <algorithm>
#include <cstdio>

#include "adit/calibration/log_settings.hpp"
#include "adit/plot/figures.hpp"
#include "adit/plot/place_figures.hpp"
#include "adit/threads/share_out.hpp"
#include "commands.hpp"
#include "configured.hpp"
#include "locate_report.hpp"
#include "mine_search.hpp"
#include "report_error.hpp"
#include "scan_reference.hpp"
#include "sweep_priors.hpp"

namespace adit {
namespace {

/// The scans that are looked for: all of the log, or one.
struct Scans {
  std::size_t first = 0;
  std::size_t end = 0;
};

struct Inputs {
  LoadedConfiguration configuration;
  Log log;
  Scans scans;
  std::vector<PlanLevel> plans;
};

Result<Scans> scans_of(const ScanSelection& selection, const Log& log) {
  if (!selection.index) return Scans{0, log.scans.size()};
  if (const auto there = check_index(*selection.index, log, selection.log); !there) {
    return tl::unexpected(there.error());
  }
  return Scans{*selection.index, *selection.index + 1};
}

Result<Inputs> read_inputs(const LocateArguments& arguments, const ScanSelection& selection) {
  Inputs inputs;
  auto configuration = load_configuration(arguments.config);
  if (!configuration) return tl::unexpected(configuration.error());
  inputs.configuration = std::move(*configuration);
  auto log = read_log(selection.log, log_options(inputs.configuration));
  if (!log) return tl::unexpected(log.error());
  inputs.log = std::move(*log);
  const auto scans = scans_of(selection, inputs.log);
  if (!scans) return tl::unexpected(scans.error());
  inputs.scans = *scans;
  auto plans = read_plan_levels(arguments.map);
  if (!plans) return tl::unexpected(plans.error());
  inputs.plans = std::move(*plans);
  return inputs;
}

/// Poses on the level of the best, and the scan on it.
Result<void> draw(const std::string& path, const MineAnswer& answer, const LaserScan& scan,
                  const std::vector<MineLevel>& levels) {
  const std::size_t level = answer.poses.empty() ? 0 : answer.poses.front().level;
  const std::vector<Segment> plan = plan_of(levels[level].map);
  std::vector<WeightedPose> poses;
  for (const LevelPose& pose : answer.poses) {
    if (pose.level != level) continue;
    poses.push_back({pose.ranked.pose, pose.ranked.covariance, pose.ranked.weight});
  }
  PictureOptions options;
  options.title = to_string(answer.verdict);
  if (!levels[level].name.empty()) options.title += ", level " + levels[level].name;
  return draw_ranked_poses(path, {plan, poses, &scan}, options);
}

/// Looks for the scans, some at a time, and prints the answers in the log's order. Returns the last
/// answer.
MineAnswer locate_all(const Inputs& inputs, const std::vector<MineLevel>& levels,
                      const LocalizerSettings& settings, const LocateArguments& arguments) {
  constexpr std::size_t kAtOnce = 16;  // scans a thread
  const int threads = arguments.threads.value_or(1);
  const SweepPriors priors(inputs.log, settings);
  std::vector<MineAnswer> answers;
  for (std::size_t begin = inputs.scans.first; begin < inputs.scans.end; begin += answers.size()) {
    const std::size_t most = kAtOnce * static_cast<std::size_t>(threads);
    answers.assign(std::min(most, inputs.scans.end - begin), {});
    share_out(answers.size(), threads, [&] {
      return [&, search = MineSearch(levels, settings)](std::size_t i) mutable {
        const LaserScan& scan = inputs.log.scans[begin + i].scan;
        answers[i] = search.locate(scan, priors.of(scan));
      };
    });
    for (std::size_t i = 0; i < answers.size(); ++i) {
      fmt::print("{}", arguments.json ? locate_json(answers[i], levels).to_text(false) + "\n"
                                      : locate_table(begin + i, answers[i], levels));
    }
    std::fflush(stdout);
  }
  return answers.empty() ? MineAnswer{} : answers.back();
}

}  // namespace

int run_locate(const LocateArguments& arguments) {
  const auto selection = parse_scan_selection(arguments.scan);
  if (!selection) return report(selection.error(), kWrongCall);
  if (!arguments.output.empty()) {
    const auto named = check_picture_name(arguments.output);
    if (!named) return report(named.error(), kWrongCall);
    if (!selection->index) return report({"a picture is of one scan, not of all", {}}, kWrongCall);
  }
  const auto inputs = read_inputs(arguments, *selection);
  if (!inputs) return report(inputs.error());
  const LogSettings settings = settle(inputs->configuration, inputs->log);
  const LocalizerSettings& values = settings.configuration.localizer;
  const auto levels = prepare_levels(
      inputs->plans, settings.configuration.map,
      {values.places, threads_or_cores(arguments.threads.value_or(0)), arguments.index});
  if (!levels) return report(levels.error());
  const MineAnswer answer = locate_all(*inputs, *levels, values, arguments);
  if (arguments.output.empty()) return kDone;
  const LaserScan& scan = inputs->log.scans[inputs->scans.first].scan;
  if (const auto drawn = draw(arguments.output, answer, scan, *levels); !drawn) {
    return report(drawn.error());
  }
  fmt::print(stderr, "adit: wrote {}\n", arguments.output);
  return kDone;
}

}  // namespace adit
