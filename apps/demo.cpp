#include <fmt/core.h>

#include <filesystem>

#include "adit/config/configuration.hpp"
#include "adit/io/carmen.hpp"
#include "adit/io/estimates.hpp"
#include "adit/io/plan.hpp"
#include "adit/io/trajectory.hpp"
#include "adit/simulation/clutter.hpp"
#include "commands.hpp"
#include "demo_pictures.hpp"
#include "demo_tables.hpp"
#include "recording_log.hpp"
#include "report_error.hpp"

namespace adit {
namespace {

constexpr int kClutter = 8;
constexpr std::size_t kPicturedStop = 8;  // in the middle of the run, as in the paper's Fig. 10

struct Experiment {
  World world = mockup();
  ScannerSpec scanner = cyclone();
  DriveOptions drive;
  Recording recording;
  Configuration configuration;
};

Experiment run_experiment(std::uint64_t seed) {
  Experiment experiment;
  experiment.world.path = mockup_path();
  add_clutter(experiment.world, clutter_of(kClutter), seed);
  experiment.recording = record_stops(experiment.world, experiment.world.path, experiment.scanner,
                                      experiment.drive, seed);
  LocalizerSettings& settings = experiment.configuration.localizer;
  settings.scanner = experiment.scanner.model;
  settings.odometry = experiment.drive.odometry;
  settings.map.sigma_m = 0.0;                     // the mockup's walls stand where its plan says
  settings.localizer.features_every_scan = true;  // as the paper did; its figures show them
  return experiment;
}

/// The run through the localizer; the pictures of one turn are drawn on the way.
Result<std::vector<EstimateRow>> localize(const Experiment& experiment, const LineMap& map,
                                          const std::filesystem::path& folder) {
  const Recording& recording = experiment.recording;
  Localizer localizer(map, experiment.configuration.localizer);
  localizer.start(recording.first_guess.pose, recording.first_guess.covariance);
  std::vector<EstimateRow> rows;
  for (std::size_t i = 0; i < recording.scans.size(); ++i) {
    rows.push_back(to_row(localizer.update(recording.scans[i], recording.odometry[i])));
    if (i != kPicturedStop) continue;
    const auto drawn = draw_demo_turn(folder, map, localizer, recording.scans[i]);
    if (!drawn) return tl::unexpected(drawn.error());
  }
  return rows;
}

Result<void> write_files(const Experiment& experiment, const std::vector<EstimateRow>& rows,
                         const std::filesystem::path& folder) {
  const auto file = [&](const char* name) { return (folder / name).string(); };
  std::vector<StampedPose> trajectory;
  for (const EstimateRow& row : rows) trajectory.push_back({row.stamp, row.pose});
  const Log log = to_log(experiment.recording, experiment.scanner);
  return write_plan(experiment.world.plan, file("plan.csv"))
      .and_then([&] { return write_carmen(log, file("log.clf")); })
      .and_then([&] { return write_trajectory(experiment.recording.truth, file("truth.tum")); })
      .and_then([&] {
        return write_configuration(experiment.configuration, file("config.toml"),
                                   {"scanner", "odometry", "map.sigma_m"});
      })
      .and_then([&] { return write_trajectory(trajectory, file("trajectory.tum")); })
      .and_then([&] { return write_estimates(rows, file("estimates.csv")); });
}

}  // namespace

int run_demo(const DemoArguments& arguments) {
  const std::filesystem::path folder = arguments.output;
  std::error_code code;
  std::filesystem::create_directories(folder, code);
  if (code) return report({"cannot make the folder: " + code.message(), folder.string()});

  const Experiment experiment = run_experiment(arguments.seed);
  const LineMap map = LineMap::build(experiment.world.plan);
  const auto rows = localize(experiment, map, folder);
  if (!rows) return report(rows.error());
  std::vector<Pose2> estimated;
  for (const EstimateRow& row : *rows) estimated.push_back(row.pose);
  const auto done =
      write_files(experiment, *rows, folder)
          .and_then(
              [&] { return draw_demo_visibility(folder, map, experiment.configuration.localizer); })
          .and_then([&] {
            return draw_demo_paths(folder, map, experiment.world.path, experiment.recording.truth,
                                   estimated);
          });
  if (!done) return report(done.error());
  fmt::print("The paper's experiment, simulated: {} stops, {} pieces of clutter, seed {}.\n\n{}\n",
             rows->size(), kClutter, arguments.seed,
             demo_tables(experiment.recording.truth, *rows));
  fmt::print("plan, log, truth, estimates and pictures (fig04 to fig13) are in {}\n",
             folder.string());
  return kDone;
}

}  // namespace adit
