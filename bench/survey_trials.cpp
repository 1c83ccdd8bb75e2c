// Surveys a log and prints what docs/benchmarks.md says of it: time, memory, and where verified
// relations of poses are given, the error against them (Kuemmerle et al. 2009).
//
//   survey_trials LOG [RELATIONS|-] [TRAJECTORY|-] [THREADS] [CONFIG]

#include <fmt/core.h>
#include <sys/resource.h>

#include <chrono>
#include <cstdlib>
#include <string>

#include "adit/calibration/log_settings.hpp"
#include "adit/evaluation/relations.hpp"
#include "adit/io/log_file.hpp"
#include "adit/io/relations.hpp"
#include "adit/io/trajectory.hpp"
#include "adit/survey/drive_survey.hpp"

namespace adit {
namespace {

double seconds() {
  using Clock = std::chrono::steady_clock;
  return std::chrono::duration<double>(Clock::now().time_since_epoch()).count();
}

double cpu_seconds() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_utime.tv_sec) +
         1e-6 * static_cast<double>(usage.ru_utime.tv_usec);
}

double peak_megabytes() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024.0;
}

Result<void> judge(const std::string& path, const std::vector<StampedPose>& trajectory) {
  const auto read = read_relations(path);
  if (!read) return tl::unexpected(read.error());
  std::vector<Relation> relations;
  for (const PoseRelation& r : *read) relations.push_back({r.from_stamp, r.to_stamp, r.from_to});
  const RelationsMetric m = relations_metric(samples_of(trajectory), relations);
  fmt::print(
      "relations {} matched {}  translation mean {:.4f} std {:.4f} max {:.3f} m  rotation mean "
      "{:.3f} std {:.3f} deg\n",
      m.count, m.matched, m.translation_mean, m.translation_std, m.translation_max,
      m.rotation_mean_deg, m.rotation_std_deg);
  return {};
}

Result<void> run(int argc, char** argv) {
  const auto log = LogFile::open(argv[1]);
  if (!log) return tl::unexpected(log.error());
  const auto configuration =
      argc > 5 ? read_configuration(argv[5]) : Result<LoadedConfiguration>{LoadedConfiguration{}};
  if (!configuration) return tl::unexpected(configuration.error());
  const LogSettings settings = settle(*configuration, log->sample());
  const LocalizerSettings& values = settings.configuration.localizer;
  const int threads = argc > 4 ? std::atoi(argv[4]) : 2;
  const double start = seconds();
  const double cpu_start = cpu_seconds();
  DriveSurvey survey(values.odometry, settings.configuration.drive);
  std::vector<double> stamps;
  auto followed = log->visit_scans([&](const LogScan& entry) {
    survey.add(entry.scan, values.scanner_of(entry.scan), entry.odom_from_vehicle);
    stamps.push_back(entry.scan.stamp);
  });
  if (!followed) return followed;
  fmt::print("tracked {:.1f} s\n", seconds() - start);
  std::string last;
  const auto finished = survey.finish(threads, [&](const char* stage, double) {
    if (last == stage) return;
    last = stage;
    fmt::print(stderr, "{:6.1f} s  {}\n", seconds() - start, stage);
  });
  if (!finished) return tl::unexpected(finished.error());
  const DriveResult& result = *finished;
  fmt::print("closures {}  pairs {}\n", result.closures.size(), result.pairs);
  fmt::print("scans {}  keyframes {}  {:.1f} s  cpu {:.1f} s  peak {:.0f} MB\n", log->scans(),
             result.keyframes.size(), seconds() - start, cpu_seconds() - cpu_start,
             peak_megabytes());
  std::vector<StampedPose> trajectory;
  for (std::size_t i = 0; i < result.poses.size(); ++i) {
    trajectory.push_back({stamps[i], result.poses[i].map_from_vehicle});
  }
  if (argc > 2 && std::string(argv[2]) != "-") {
    if (auto judged = judge(argv[2], trajectory); !judged) return judged;
  }
  if (argc > 3 && std::string(argv[3]) != "-") return write_trajectory(trajectory, argv[3]);
  return {};
}

}  // namespace
}  // namespace adit

int main(int argc, char** argv) {
  if (argc < 2) {
    fmt::print(stderr, "survey_trials LOG [RELATIONS|-] [TRAJECTORY|-] [THREADS] [CONFIG]\n");
    return 2;
  }
  const auto done = adit::run(argc, argv);
  if (done) return 0;
  fmt::print(stderr, "{}\n", to_string(done.error()));
  return 1;
}
