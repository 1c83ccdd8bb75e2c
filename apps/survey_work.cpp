#include "survey_work.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <memory>

#include "adit/io/trajectory.hpp"
#include "adit/relocation/share_out.hpp"
#include "adit/survey/drive_survey.hpp"
#include "adit/survey/known_positions.hpp"
#include "configured.hpp"
#include "progress.hpp"
#include "replay.hpp"

namespace adit {
namespace {

/// Walls are made with the model of one laser alone; the others help to follow the drive.
constexpr int kWallScanner = 0;

/// A bar for each stage of a survey.
class StageBars {
 public:
  void show(const std::string& stage, double part) {
    if (stage != stage_) {
      bar_ = nullptr;
      bar_ = std::make_unique<Progress>(stage, kSteps);
      stage_ = stage;
      shown_ = 0;
    }
    const auto reached = static_cast<std::size_t>(std::clamp(part, 0.0, 1.0) * kSteps);
    for (; shown_ < reached; ++shown_) bar_->advance();
  }

 private:
  static constexpr std::size_t kSteps = 100;
  std::string stage_;
  std::size_t shown_ = 0;
  std::unique_ptr<Progress> bar_;
};

/// Dead reckoning that never reports a move says nothing of the way.
bool has_moved(const Log& log) {
  constexpr double kLeast = 1e-6;  // m and rad
  const Pose2& first = log.scans.front().odom_from_vehicle;
  return std::any_of(log.scans.begin(), log.scans.end(), [&](const LogScan& entry) {
    return difference(first, entry.odom_from_vehicle).norm() > kLeast;
  });
}

/// The poses of the log's scans in a plan that was there before, as `adit localize` finds them.
Replay localize_in(const std::vector<Segment>& plan, const Log& log, const Configuration& values,
                   const std::optional<Pose2>& start) {
  const LineMap map = LineMap::build(plan, values.map);
  return replay(log, map, values.localizer, start);
}

/// Hands what was found in the plan to the survey; counts the scans.
std::size_t know_places(const Replay& found, DriveSurvey& survey) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < found.rows.size(); ++i) {
    const EstimateRow& row = found.rows[i];
    if (row.status != Status::ok && row.status != Status::degraded) continue;
    if (!row.covariance.allFinite()) continue;
    survey.know_place(i, row.pose, row.covariance);
    ++count;
  }
  return count;
}

Result<DriveResult> drive_of(const Log& log, const SurveyArguments& arguments,
                             const SurveyCall& call, StageBars& bars, Surveyed& out) {
  const Configuration& values = out.settings.configuration;
  DriveSurvey survey(values.localizer.odometry, values.drive);
  for (std::size_t i = 0; i < log.scans.size(); ++i) {
    const LogScan& entry = log.scans[i];
    survey.add(entry.scan, values.localizer.scanner_of(entry.scan), entry.odom_from_vehicle);
    bars.show("following the drive",
              static_cast<double>(i + 1) / static_cast<double>(log.scans.size()));
  }
  if (!out.plan.empty()) {
    out.places_in_plan = know_places(localize_in(out.plan, log, values, call.start), survey);
    if (out.places_in_plan == 0) {
      return fail("no scan was found in the plan; --start says where the drive began",
                  arguments.update);
    }
  }
  const int threads = threads_or_cores(arguments.threads.value_or(0));
  auto result =
      survey.finish(threads, [&](const char* stage, double part) { bars.show(stage, part); });
  if (!result) return fail(result.error().message, arguments.log);
  return result;
}

/// From the drive alone. The scans leave the log.
Result<void> survey_drive(Log& log, const SurveyArguments& arguments, const SurveyCall& call,
                          StageBars& bars, Surveyed& out) {
  if (!has_moved(log)) {
    return fail("its odometry reports no move: a survey of a drive needs it; without, --poses",
                arguments.log);
  }
  const Result<DriveResult> surveyed = drive_of(log, arguments, call, bars, out);
  if (!surveyed) return tl::unexpected(surveyed.error());
  const DriveResult& drive = *surveyed;
  for (std::size_t i = 0; i < log.scans.size(); ++i) {
    const SurveyedPose& at = drive.poses[i];
    LaserScan& scan = log.scans[i].scan;
    out.trajectory.push_back({scan.stamp, at.map_from_vehicle});
    if (scan.scanner != kWallScanner) {
      ++out.of_other_lasers;
      continue;
    }
    out.scans.push_back({std::move(scan), at.map_from_vehicle, at.covariance});
  }
  log.scans = {};
  out.keyframes = drive.keyframes.size();
  out.pairs = drive.pairs;
  for (const Closure& c : drive.closures) {
    out.closures.push_back({drive.keyframes[c.from], drive.keyframes[c.to], c.from_to});
  }
  out.walls = survey_walls(out.scans, out.settings.configuration.localizer.scanner,
                           out.settings.configuration.walls, {},
                           [&](double part) { bars.show("drawing walls", part); });
  return {};
}

/// From positions that are known.
Result<void> survey_positions(Log& log, const SurveyArguments& arguments, StageBars& bars,
                              Surveyed& out) {
  const auto known = read_trajectory(arguments.poses);
  if (!known) return tl::unexpected(known.error());
  std::vector<LaserScan> scans;
  for (LogScan& entry : log.scans) {
    if (entry.scan.scanner == kWallScanner) {
      scans.push_back(std::move(entry.scan));
    } else {
      ++out.of_other_lasers;
    }
  }
  log.scans = {};
  const Configuration& values = out.settings.configuration;
  const auto placed = place_scans(scans, *known, values.positions.headings);
  if (!placed) return fail(placed.error().message, arguments.poses);
  out.by_station = static_cast<std::size_t>(std::count_if(
      placed->begin(), placed->end(), [](const PositionedScan& s) { return !s.has_own_pose; }));
  auto survey = survey_known_positions(
      *placed, values.localizer.scanner, values.positions, values.walls,
      [&](double part) { bars.show("surveying from known positions", part); });
  if (!survey) return fail(survey.error().message, arguments.log);
  for (const SurveyedScan& scan : survey->scans) {
    if (!survey->stations[static_cast<std::size_t>(scan.station)].placed) continue;
    out.trajectory.push_back({scans[scan.scan].stamp, scan.map_from_vehicle});
  }
  for (const SurveyedStation& s : survey->stations) {
    if (s.placed) {
      out.stations.push_back({s.position.x(), s.position.y(), s.heading.heading_rad});
    } else {
      out.unplaced.push_back(s.position);
    }
  }
  out.scans = std::move(survey->levelled);
  out.visits = std::move(survey->visits);
  out.walls = std::move(survey->walls);
  return {};
}

}  // namespace

Result<Surveyed> survey_log(const SurveyArguments& arguments, const SurveyCall& call) {
  const auto configuration = load_configuration(arguments.config);
  if (!configuration) return tl::unexpected(configuration.error());
  Surveyed out;
  if (!arguments.update.empty()) {
    auto plan = read_plan(arguments.update);
    if (!plan) return tl::unexpected(plan.error());
    out.plan = std::move(plan->segments);
  }
  auto log = read_log(arguments.log, log_options(*configuration));
  if (!log) return tl::unexpected(log.error());
  out.settings = settle(*configuration, *log);
  out.log = log->summary;
  StageBars bars;
  const auto done = arguments.poses.empty() ? survey_drive(*log, arguments, call, bars, out)
                                            : survey_positions(*log, arguments, bars, out);
  if (!done) return tl::unexpected(done.error());
  if (!arguments.update.empty()) {
    const Configuration& values = out.settings.configuration;
    out.difference = compare_with_plan(out.plan, out.walls, out.scans, values.localizer.scanner,
                                       values.changes, values.walls, out.visits);
  }
  return out;
}

}  // namespace adit
