#include <fmt/core.h>

#include "adit/evaluation/join.hpp"
#include "adit/io/estimates.hpp"
#include "adit/io/plan.hpp"
#include "adit/io/trajectory.hpp"
#include "adit/plot/figures.hpp"
#include "commands.hpp"
#include "configured.hpp"
#include "parse_pose.hpp"
#include "report_error.hpp"
#include "scan_reference.hpp"

namespace adit {
namespace {

struct Inputs {
  LoadedConfiguration configuration;
  LineMap map;
};

/// The configuration, and the plan cleaned under it.
Result<Inputs> read_inputs(const PlotArguments& arguments) {
  auto configuration = load_configuration(arguments.config);
  if (!configuration) return tl::unexpected(configuration.error());
  const auto plan = read_plan(arguments.map);
  if (!plan) return tl::unexpected(plan.error());
  Inputs inputs{std::move(*configuration), {}};
  inputs.map = LineMap::build(plan->segments, inputs.configuration.values.map);
  return inputs;
}

/// What is wrong with the call before any file is read: kDone or the exit status.
int check_call(const PlotArguments& arguments) {
  const auto named = check_picture_name(arguments.output);
  return named ? kDone : report(named.error(), kWrongCall);
}

int finish(const Result<void>& drawn, const std::string& path) {
  if (!drawn) return report(drawn.error());
  fmt::print("wrote {}\n", path);
  return kDone;
}

struct Run {
  std::vector<double> stamps;
  std::vector<TrajectoryPoint> points;
};

Result<Run> read_run(const std::string& path) {
  if (path.ends_with(".csv")) {
    return read_estimates(path).map([](const std::vector<EstimateRow>& rows) {
      Run run{stamps_of(rows), {}};
      for (const EstimateRow& row : rows) {
        run.points.push_back({row.pose, row.covariance, row.status, row.protection_m, {}});
      }
      return run;
    });
  }
  return read_trajectory(path).map([](const std::vector<StampedPose>& poses) {
    Run run{stamps_of(poses), {}};
    for (const StampedPose& pose : poses) run.points.push_back({pose.pose, {}, {}, {}, {}});
    return run;
  });
}

void add_errors(const std::vector<StampedPose>& truth, Run& run) {
  const StampIndex index(stamps_of(truth));
  for (std::size_t i = 0; i < run.points.size(); ++i) {
    const auto at = index.nearest(run.stamps[i]);
    if (!at) continue;
    const Vector2d apart = run.points[i].pose.translation() - truth[*at].pose.translation();
    run.points[i].error_m = apart.norm();
  }
}

}  // namespace

int run_plot_map(const PlotArguments& arguments) {
  if (const int wrong = check_call(arguments)) return wrong;
  const auto inputs = read_inputs(arguments);
  if (!inputs) return report(inputs.error());
  return finish(draw_map(arguments.output, plan_of(inputs->map)), arguments.output);
}

int run_plot_scan(const PlotArguments& arguments) {
  if (const int wrong = check_call(arguments)) return wrong;
  const auto reference = parse_scan_reference(arguments.scan);
  if (!reference) return report(reference.error(), kWrongCall);
  const auto configuration = load_configuration(arguments.config);
  if (!configuration) return report(configuration.error());
  const auto scan = read_referenced_scan(*reference, *configuration);
  if (!scan) return report(scan.error());
  const LocalizerSettings& settings = scan->settings.configuration.localizer;
  Extractor extractor;
  ScanView view;
  view.scan = &scan->scan.scan;
  view.features = &extractor.extract(scan->scan.scan, settings.scanner_of(scan->scan.scan),
                                     settings.extraction);
  return finish(draw_scan(arguments.output, view), arguments.output);
}

int run_plot_features(const PlotArguments& arguments) {
  if (const int wrong = check_call(arguments)) return wrong;
  const auto pose = parse_pose(arguments.pose);
  if (!pose) return report(pose.error(), kWrongCall);
  const auto inputs = read_inputs(arguments);
  if (!inputs) return report(inputs.error());
  const LocalizerSettings& settings = inputs->configuration.values.localizer;
  Visibility visibility;
  visibility.sweep(inputs->map, pose->translation(), settings.scanner.max_range_m);
  ViewFromPlace view;
  view.position = pose->translation();
  view.intervals.assign(visibility.intervals().begin(), visibility.intervals().end());
  predict_features(inputs->map, visibility, view.position, settings.prediction, view.features);
  return finish(draw_visible_features(arguments.output, plan_of(inputs->map),
                                      std::vector<ViewFromPlace>{view}),
                arguments.output);
}

int run_plot_match(const PlotArguments& arguments) {
  if (const int wrong = check_call(arguments)) return wrong;
  const auto pose = parse_pose(arguments.pose);
  if (!pose) return report(pose.error(), kWrongCall);
  const auto reference = parse_scan_reference(arguments.scan);
  if (!reference) return report(reference.error(), kWrongCall);
  const auto inputs = read_inputs(arguments);
  if (!inputs) return report(inputs.error());
  const auto scan = read_referenced_scan(*reference, inputs->configuration);
  if (!scan) return report(scan.error());
  LocalizerSettings settings = scan->settings.configuration.localizer;
  settings.localizer.features_every_scan = true;  // the picture is of them
  Localizer localizer(inputs->map, settings);
  localizer.start(*pose);
  for (const StampedPose& message : scan->odometry) localizer.add_odometry(message);
  const Estimate& estimate = localizer.update(scan->scan.scan, scan->scan.odom_from_vehicle);
  const Turn turn = localizer.last_turn();
  const Pose2 mounting = scan->scan.scan.vehicle_from_laser;
  const Vector2d observer = (turn.predicted.pose * mounting).translation();
  const std::vector<Segment> plan = plan_of(inputs->map);
  MatchView view;
  view.plan = plan;
  view.model = &turn.model_features;
  view.map_from_model = {observer.x(), observer.y(), 0.0};
  view.sensed = &turn.sensed_features;
  view.map_from_sensed = estimate.pose * mounting;
  view.pairs = estimate.pairs;
  fmt::print("{}: x {:.3f} m, y {:.3f} m, heading {:.2f} degrees, {} pairs\n",
             to_string(estimate.status), estimate.pose.x, estimate.pose.y,
             degrees(estimate.pose.theta), estimate.pairs.size());
  return finish(draw_match(arguments.output, view), arguments.output);
}

int run_plot_trajectory(const PlotArguments& arguments) {
  if (const int wrong = check_call(arguments)) return wrong;
  const auto inputs = read_inputs(arguments);
  if (!inputs) return report(inputs.error());
  auto run = read_run(arguments.trajectory);
  if (!run) return report(run.error());
  std::vector<Pose2> reference;
  if (!arguments.truth.empty()) {
    const auto truth = read_trajectory(arguments.truth);
    if (!truth) return report(truth.error());
    for (const StampedPose& pose : *truth) reference.push_back(pose.pose);
    add_errors(*truth, *run);
  }
  return finish(draw_trajectory(arguments.output, plan_of(inputs->map), run->points, reference),
                arguments.output);
}

}  // namespace adit
