#include <fmt/core.h>

#include <filesystem>
#include <functional>

#include "adit/io/plan.hpp"
#include "adit/io/trajectory.hpp"
#include "commands.hpp"
#include "report_error.hpp"
#include "survey_files.hpp"

namespace adit {
namespace {

/// The files of a survey: where each goes, and what writes it.
struct SurveyFile {
  std::string path;
  std::function<Result<void>(const std::string&)> write;
};

/// All of them or none: after a failure what was newly made before it is taken away.
Result<void> write_files(const std::vector<SurveyFile>& files) {
  namespace fs = std::filesystem;
  std::vector<std::string> made;
  for (const SurveyFile& file : files) {
    if (file.path.empty()) continue;
    std::error_code code;
    const bool is_new = fs::symlink_status(file.path, code).type() == fs::file_type::not_found;
    if (auto done = file.write(file.path); !done) {
      for (const std::string& earlier : made) fs::remove(earlier, code);
      return done;
    }
    if (is_new) made.push_back(file.path);
  }
  return {};
}

/// Those of the changes that the call accepts.
Result<std::vector<PlanChangeItem>> accepted(const PlanDifference& difference,
                                             const SurveyCall& call, const std::string& plan) {
  if (call.applies_all) return difference.items;
  std::vector<PlanChangeItem> items;
  for (const int number : call.changes) {
    const auto place = static_cast<std::size_t>(number - 1);
    if (place >= difference.items.size()) {
      return fail(
          fmt::format("there is no change {}: {} were found", number, difference.items.size()),
          plan);
    }
    items.push_back(difference.items[place]);
  }
  return items;
}

Result<void> write_results(const Surveyed& surveyed, const SurveyCall& call,
                           const SurveyArguments& arguments) {
  using Path = const std::string&;
  std::vector<Segment> plan = surveyed.walls.segments();
  if (call.applies) {
    const auto items = accepted(*surveyed.difference, call, arguments.update);
    if (!items) return tl::unexpected(items.error());
    plan = apply_changes(surveyed.plan, *items);
  }
  const bool lists = surveyed.difference && !call.applies;
  return write_files(
      {{arguments.trajectory,
        [&](Path path) { return write_trajectory(surveyed.trajectory, path); }},
       {arguments.walls, [&](Path path) { return write_walls(surveyed.walls, path); }},
       {arguments.report, [&](Path path) { return write_json(survey_report(surveyed), path); }},
       {arguments.picture, [&](Path path) { return draw_surveyed(surveyed, path); }},
       {arguments.output, [&](Path path) {
          return lists ? write_changes(*surveyed.difference, path) : write_plan(plan, path);
        }}});
}

/// A few lines for the terminal.
std::string summary_of(const Surveyed& surveyed) {
  std::string text = fmt::format("{} scans", surveyed.trajectory.size());
  if (surveyed.stations.empty()) {
    text +=
        fmt::format(", {} kept, {} loop closures", surveyed.keyframes, surveyed.closures.size());
  } else {
    text += fmt::format(" of {} stations", surveyed.stations.size());
    for (const Vector2d& p : surveyed.unplaced) {
      text +=
          fmt::format("\nleft out, no heading was found: station at {:.2f}, {:.2f}", p.x(), p.y());
    }
  }
  if (!surveyed.plan.empty() && surveyed.stations.empty()) {
    text += fmt::format(", {} found in the plan", surveyed.places_in_plan);
  }
  const std::vector<Segment> segments = surveyed.walls.segments();
  double length = 0.0;
  for (const Segment& segment : segments) length += segment.length();
  text += fmt::format("\n{} segments, {:.1f} m of wall\n", segments.size(), length);
  if (surveyed.difference) text += changes_summary(*surveyed.difference);
  return text;
}

}  // namespace

int run_survey(const SurveyArguments& arguments) {
  const auto call = survey_call(arguments);
  if (!call) {
    return report(call.error(), call.error().file.empty() ? kWrongCall : kFailed);
  }
  const auto surveyed = survey_log(arguments, *call);
  if (!surveyed) return report(surveyed.error());
  if (surveyed->walls.lines.empty()) {
    return report({"no wall was seen often enough to be drawn", arguments.log});
  }
  if (const auto written = write_results(*surveyed, *call, arguments); !written) {
    return report(written.error());
  }
  if (surveyed->of_other_lasers > 0) {
    fmt::print(stderr, "{} scans of other lasers than the first are in no wall\n",
               surveyed->of_other_lasers);
  }
  if (surveyed->by_station > 0) {
    fmt::print(stderr, "{} scans have no pose of their stamp: they are placed with their station\n",
               surveyed->by_station);
  }
  fmt::print("{}wrote {}\n", summary_of(*surveyed), arguments.output);
  return kDone;
}

}  // namespace adit
