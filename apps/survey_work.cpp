#include "survey_work.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <functional>
#include <memory>
#include <utility>

#include "adit/io/log_file.hpp"
#include "adit/io/trajectory.hpp"
#include "adit/survey/drive_survey.hpp"
#include "adit/survey/known_positions.hpp"
#include "adit/threads/share_out.hpp"
#include "configured.hpp"
#include "progress.hpp"
#include "replay.hpp"

namespace adit {
namespace {

double share_of(std::size_t part, std::size_t whole) {
  return static_cast<double>(part) / static_cast<double>(whole);
}

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

/// Scans of the first laser with the poses that a survey gave to all, read from the log anew.
class LogPosedScans : public PosedScans {
 public:
  LogPosedScans(LogFile log, std::vector<SurveyedPose> poses, std::size_t scans)
      : log_(std::move(log)), poses_(std::move(poses)), scans_(scans) {}

  std::size_t size() const override { return scans_; }
  Result<void> visit(const std::function<void(const PosedScan&)>& take) const override {
    std::size_t i = 0;
    PosedScan posed;
    return log_.visit_scans([&](const LogScan& entry) {
      const SurveyedPose& at = poses_[i++];
      if (entry.scan.scanner != kWallScanner) return;
      posed.scan = entry.scan;
      posed.map_from_vehicle = at.map_from_vehicle;
      posed.covariance = at.covariance;
      take(posed);
    });
  }

 private:
  LogFile log_;
  std::vector<SurveyedPose> poses_;  // of the scans of all lasers
  std::size_t scans_;
};

/// Those of known positions.
class OwnedPosedScans : public PosedScanList {
 public:
  explicit OwnedPosedScans(std::vector<PosedScan> scans)
      : PosedScanList(scans), scans_(std::move(scans)) {}

 private:
  std::vector<PosedScan> scans_;
};

/// What the walls are made of.
struct WallScans {
  std::unique_ptr<PosedScans> scans;
  std::vector<int> visits;  // where they are known
};

/// Dead reckoning that never reports a move says nothing of the way.
bool has_moved(const Log& log) {
  constexpr double kLeast = 1e-6;  // m and rad
  const Pose2& first = log.scans.front().odom_from_vehicle;
  return std::any_of(log.scans.begin(), log.scans.end(), [&](const LogScan& entry) {
    return difference(first, entry.odom_from_vehicle).norm() > kLeast;
  });
}

/// Tells the survey where scans are found in a plan that was there before, as `adit localize` finds
/// them; counts these.
Result<std::size_t> know_places(const LogFile& log, const Surveyed& surveyed,
                                const std::optional<Pose2>& start, StageBars& bars,
                                DriveSurvey& survey) {
  const Configuration& values = surveyed.settings.configuration;
  const LineMap map = LineMap::build(surveyed.plan, values.map);
  Replayer replayer(log.sample().odometry, map, values.localizer, {false, start, std::nullopt});
  std::size_t count = 0;
  std::size_t i = 0;
  const auto done = log.visit_scans([&](const LogScan& entry) {
    const EstimateRow row = replayer.add(entry);
    const std::size_t scan = i++;
    bars.show("finding the drive in the plan", share_of(i, log.scans()));
    if (row.status != Status::ok && row.status != Status::degraded) return;
    if (!row.covariance.allFinite()) return;
    survey.know_place(scan, row.pose, row.covariance);
    ++count;
  });
  if (!done) return tl::unexpected(done.error());
  return count;
}

Result<DriveResult> drive_of(const LogFile& log, const SurveyArguments& arguments,
                             const SurveyCall& call, StageBars& bars, Surveyed& out) {
  const Configuration& values = out.settings.configuration;
  DriveSurvey survey(values.localizer.odometry, values.drive);
  std::size_t scans = 0;
  const auto followed = log.visit_scans([&](const LogScan& entry) {
    survey.add(entry.scan, values.localizer.scanner_of(entry.scan), entry.odom_from_vehicle);
    out.trajectory.push_back({entry.scan.stamp, {}});
    if (entry.scan.scanner != kWallScanner) ++out.of_other_lasers;
    bars.show("following the drive", share_of(++scans, log.scans()));
  });
  if (!followed) return tl::unexpected(followed.error());
  if (!out.plan.empty()) {
    const auto count = know_places(log, out, call.start, bars, survey);
    if (!count) return tl::unexpected(count.error());
    out.places_in_plan = *count;
    if (*count == 0) {
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

/// From the drive alone.
Result<WallScans> survey_drive(LogFile log, const SurveyArguments& arguments,
                               const SurveyCall& call, StageBars& bars, Surveyed& out) {
  if (!has_moved(log.sample())) {
    return fail("its odometry reports no move: a survey of a drive needs it; without, --poses",
                arguments.log);
  }
  auto drive = drive_of(log, arguments, call, bars, out);
  if (!drive) return tl::unexpected(drive.error());
  for (std::size_t i = 0; i < out.trajectory.size(); ++i) {
    out.trajectory[i].pose = drive->poses[i].map_from_vehicle;
  }
  out.keyframes = drive->keyframes.size();
  out.pairs = drive->pairs;
  for (const Closure& c : drive->closures) {
    out.closures.push_back({drive->keyframes[c.from], drive->keyframes[c.to], c.from_to});
  }
  const std::size_t scans = log.scans() - out.of_other_lasers;
  auto posed = std::make_unique<LogPosedScans>(std::move(log), std::move(drive->poses), scans);
  const Configuration& values = out.settings.configuration;
  auto walls = survey_walls(*posed, values.localizer.scanner, values.walls, {},
                            [&](double part) { bars.show("drawing walls", part); });
  if (!walls) return tl::unexpected(walls.error());
  out.walls = std::move(*walls);
  return WallScans{std::move(posed), {}};
}

/// From positions that are known.
Result<WallScans> survey_positions(const LogFile& log, const SurveyArguments& arguments,
                                   StageBars& bars, Surveyed& out) {
  const auto known = read_trajectory(arguments.poses);
  if (!known) return tl::unexpected(known.error());
  std::vector<LaserScan> scans;
  const auto read = log.visit_scans([&](const LogScan& entry) {
    if (entry.scan.scanner == kWallScanner) {
      scans.push_back(entry.scan);
    } else {
      ++out.of_other_lasers;
    }
  });
  if (!read) return tl::unexpected(read.error());
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
  out.walls = std::move(survey->walls);
  return WallScans{std::make_unique<OwnedPosedScans>(std::move(survey->levelled)),
                   std::move(survey->visits)};
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
  auto log = LogFile::open(arguments.log, log_options(*configuration));
  if (!log) return tl::unexpected(log.error());
  out.settings = settle(*configuration, log->sample());
  out.log = log->sample().summary;
  StageBars bars;
  const auto scans = arguments.poses.empty()
                         ? survey_drive(std::move(*log), arguments, call, bars, out)
                         : survey_positions(*log, arguments, bars, out);
  if (!scans) return tl::unexpected(scans.error());
  if (!arguments.update.empty()) {
    const Configuration& values = out.settings.configuration;
    bars.show("comparing with the plan", 0.0);
    auto difference =
        compare_with_plan(out.plan, out.walls, *scans->scans, values.localizer.scanner,
                          values.changes, values.walls, scans->visits);
    if (!difference) return tl::unexpected(difference.error());
    out.difference = std::move(*difference);
    bars.show("comparing with the plan", 1.0);
  }
  return out;
}

}  // namespace adit
