#include <CLI/CLI.hpp>
#include <cstdio>
#include <functional>
#include <optional>

#include "commands.hpp"
#include "simulate_faults.hpp"

namespace {

using adit::kWrongCall;

/// What the chosen subcommand does; set by the parser's callbacks.
using Action = std::function<int()>;

void add_demo(CLI::App& app, adit::DemoArguments& args, Action& action) {
  CLI::App* command =
      app.add_subcommand("demo", "The paper's experiment: simulate, localise, tables and pictures");
  command->add_option("-o,--output", args.output, "folder for plan, log, estimates and pictures")
      ->capture_default_str();
  command->add_option("--seed", args.seed, "seed of the simulation")->capture_default_str();
  command->callback([&] { action = [&] { return run_demo(args); }; });
}

<<<<<<< HEAD
/// What the mine has that its plan has not.
void add_world_changes(CLI::App* command, adit::SimulateArguments& args) {
  command->add_option("--clutter", args.clutter, "boxes and people that no plan shows")
      ->capture_default_str()
      ->check(CLI::Range(0, 10000));
  command
      ->add_option("--clutter-kind", args.clutter_kind,
                   "free: boxes and people beside the way; at walls: against, piercing, along, "
                   "rows (each lines 15 m of the way), mixed; groups: three who walk")
      ->capture_default_str()
      ->check(CLI::IsMember({"free", "against", "piercing", "along", "rows", "mixed", "groups"}));
  command->add_option("--ramps", args.ramps, "ramps on the way, where beams meet floor or roof")
      ->capture_default_str()
      ->check(CLI::Range(0, 1000));
  command
      ->add_option("--machine-ahead", args.machine_ahead,
                   "a machine of 2.5 x 1.8 m drives so many metres ahead on the way")
      ->check(CLI::Range(3.0, 100.0));
  command->add_option("--as-built", args.as_built,
                      "how the mine differs from its plan: bend=M,reach=M,rough=M,missing=SHARE,"
                      "added=SHARE,chains=SHARE,offset=M,distortion=STRAIN, each optional");
  command
      ->add_option("--off-plan", args.off_plan,
                   "x,y,radius in m: the plan lacks what lies in this circle")
      ->delimiter(',')
      ->expected(3)
      ->check(CLI::Number);
=======
/// Drives at random, and what fails on them.
void add_drive_and_faults(CLI::App* command, adit::SimulateArguments& args) {
  command
      ->add_option("--drive", args.drive,
                   "drives at random through the openings, so many metres (default for a plan "
                   "without --path: 120)")
      ->check(CLI::Range(1.0, 1e5))
      ->excludes("--path");
  const auto count = CLI::Range(0, 1000);
  command
      ->add_option("--stops", args.stops, "places on that drive at which it stands for about 5 s")
      ->check(count);
  command->add_option("--turns", args.turns, "places at which it turns right round on the spot")
      ->check(count);
  command->add_option("--creeps", args.creeps, "steps at 0.05 m/s")->check(count);
  command->add_option("--fault", args.faults, adit::fault_help())->delimiter(',');
>>>>>>> drives
}

void add_simulate(CLI::App& app, adit::SimulateArguments& args, Action& action) {
  CLI::App* command = app.add_subcommand(
<<<<<<< HEAD
      "simulate",
      "Drive through a simulated mine: plan.csv, mine.csv, log.clf, truth.tum, config.toml");
  command->add_option("world", args.world, "mockup, panel, drift, or a plan's file (with --path)")
      ->required();
=======
      "simulate", "Drive through a simulated mine: plan.csv, log.clf, truth.tum, config.toml");
  command->add_option("world", args.world, "mockup, panel, drift, or a plan's file")->required();
>>>>>>> drives
  command->add_option("-o,--output", args.output, "folder for the results")->required();
  command->add_option("--seed", args.seed, "seed of everything random")->capture_default_str();
  add_world_changes(command, args);
  command->add_option("--scanner", args.scanner, "cyclone, sick, sick_lms or hokuyo")
      ->capture_default_str();
  command->add_option("--path", args.path, "TUM file of the poses to drive along");
  command
      ->add_option("--speed", args.speed,
                   "m/s; 0 stops and scans at each pose (default: 0 in the mockup, 1 elsewhere)")
      ->check(CLI::Range(0.0, 100.0));
  command
      ->add_option("--sweep", args.sweep, "time of one sweep in seconds; 0 = at once (default: 0)")
      ->check(CLI::Range(0.0, 10.0));
  command
      ->add_option("--odometry", args.odometry,
                   "one sigma of dead reckoning: ratio of the distance, degrees per metre, ratio "
                   "of the turn (default: 0.05,1.25,0)")
      ->delimiter(',')
      ->expected(3)
      ->check(CLI::NonNegativeNumber);
  command->add_option("--config", args.config, "TOML file: scanner and odometry");
  add_drive_and_faults(command, args);
  command->callback([&] { action = [&] { return run_simulate(args); }; });
}

constexpr const char* kPlanOrLevels =
    "plan, in metres; or a folder with one plan for each level of the mine";

void add_threads(CLI::App* command, std::optional<int>& threads, const char* text) {
  command->add_option("--threads", threads, text)->check(CLI::Range(1, 256));
}

void add_index(CLI::App* command, std::string& file) {
  command->add_option(
      "--index", file,
      "file that keeps what is looked up in the plan from run to run: read where it "
      "is of this plan, else made and written");
}

void add_localize(CLI::App& app, adit::LocalizeArguments& args, Action& action) {
  CLI::App* command =
      app.add_subcommand("localize",
                         "Where the machine was at every scan of a log: trajectory.tum, "
                         "estimates.csv, last_pose.json, report.json, timings.json");
  command->add_option("--map", args.map, kPlanOrLevels)->required();
  command->add_option("--log", args.log, "CARMEN log")->required();
  command->add_option("--start", args.start,
                      "pose at the first scan: x,y,heading in m, m, degrees; or anywhere, to look "
                      "for it in the whole plan (default: the log's first odometry pose)");
  command->add_option("--resume", args.resume,
                      "last_pose.json of an earlier run: begin there, if the scans bear it out");
  command
      ->add_option("--moved", args.moved,
                   "with --resume: how far the machine may have been moved since, one sigma in m "
                   "and degrees (default: 0.25,4)")
      ->delimiter(',')
      ->expected(2)
      ->check(CLI::NonNegativeNumber);
  command->add_option("--level", args.level,
                      "the level that the run is on, where the plan has several");
  add_threads(command, args.threads, "threads that look at the plan (default: all cores)");
  add_index(command, args.index);
  command->add_option("--config", args.config, "TOML file; see 'adit config --reference'");
  command->add_option("-o,--output", args.output, "folder for the results")->capture_default_str();
  command
      ->add_option("--estimator", args.estimator,
                   "features alone (the paper's), points: all points of the scan, from the "
                   "predicted pose, or full: features, then all points")
      ->capture_default_str()
      ->check(CLI::IsMember(adit::estimator_names()));
  command->callback([&] { action = [&] { return run_localize(args); }; });
}

void add_locate(CLI::App& app, adit::LocateArguments& args, Action& action) {
  CLI::App* command = app.add_subcommand(
      "locate", "Every pose in the mine that explains a scan, the best first, without any other");
  command->add_option("--map", args.map, kPlanOrLevels)->required();
  command->add_option("--scan", args.scan, "LOG:INDEX, counting scans from 0, or LOG:all")
      ->required();
  command->add_option("--config", args.config, "TOML file; see 'adit config --reference'");
  command->add_flag("--json", args.json, "print JSON, a line for each scan");
  command->add_option("-o,--output", args.output, "a picture of the poses over the plan");
  add_threads(command, args.threads,
              "threads that look for scans, each for one (default: 1, and all cores for what is "
              "done once for the plan); the answers are the same");
  add_index(command, args.index);
  command->callback([&] { action = [&] { return run_locate(args); }; });
}

#ifdef ADIT_WITH_SURVEY
void add_survey(CLI::App& app, adit::SurveyArguments& args, Action& action) {
  CLI::App* command = app.add_subcommand(
      "survey",
      "A plan of the walls that the scans of a log show, from dead reckoning and scans alone or "
      "from known positions; or what has changed against a plan");
  command->add_option("--log", args.log, "CARMEN log")->required();
  command->add_option("--poses", args.poses,
                      "TUM file of positions that are known; their headings need not be");
  command->add_option("--update", args.update,
                      "a plan to compare with: the output is the list of changes");
  command->add_option(
      "--apply", args.apply,
      "changes to make in that plan, \"all\" or as in 1,3-5: the output is the plan");
  command->add_option("--start", args.start,
                      "in that plan, x,y,heading in m and degrees (default: the first odometry)");
  command->add_option("--trajectory", args.trajectory,
                      "TUM file to write: the pose at every scan, in the log's order");
  command->add_option(
      "--walls", args.walls,
      "table to write (.csv): each wall with its uncertainty and what speaks for it");
  command->add_option("--report", args.report, "JSON file to write: what was read and found");
  command->add_option("--picture", args.picture, "picture to write (.png, .svg or .pdf)");
  add_threads(command, args.threads, "threads (default: all cores); the results are the same");
  command->add_option("--config", args.config, "TOML file; see 'adit config --reference'");
  command
      ->add_option("-o,--output", args.output,
                   "the plan to write (.csv), in m; with --update the changes (.json or .csv)")
      ->required();
  command->callback([&] { action = [&] { return run_survey(args); }; });
}
#endif

void add_aliases(CLI::App* map, adit::AliasesArguments& args, Action& action) {
  CLI::App* command = map->add_subcommand(
      "aliases", "Where in a plan one scan tells the place, and which places look the same");
  command->add_option("plan", args.plan, "the plan's file")->required();
  command->add_option("--scanner", args.scanner, "cyclone, sick, sick_lms or hokuyo")
      ->capture_default_str();
  command
      ->add_option("--pitch", args.pitch,
                   "places lie so far apart, in m (default: so that there are some 500)")
      ->check(CLI::Range(0.05, 1e6));
  command->add_option("-o,--output", args.output, "a picture of the places and the links");
  command->add_option("--config", args.config, "TOML file; see 'adit config --reference'");
  add_threads(command, args.threads, "threads (default: all cores); the answers are the same");
  command->callback([&] { action = [&] { return run_map_aliases(args); }; });
}

void add_evaluate(CLI::App& app, adit::EvaluateArguments& args, Action& action) {
  CLI::App* command =
      app.add_subcommand("evaluate", "Errors, consistency and relations of a trajectory");
  command->add_option("--estimate", args.estimate, "TUM trajectory or estimates.csv")->required();
  command->add_option("--truth", args.truth, "TUM trajectory of the truth, joined within 1 ms");
  command->add_option("--relations", args.relations, "relations file (Kuemmerle et al. 2009)");
  command->add_flag("--json", args.json, "print JSON");
  command->callback([&] { action = [&] { return run_evaluate(args); }; });
}

void add_map(CLI::App& app, adit::MapArguments& args, adit::AliasesArguments& aliases,
             Action& action) {
  CLI::App* command = app.add_subcommand("map", "Look at, check and convert plans");
  command->require_subcommand(1);
  const auto add = [&](const char* name, const char* text, int (*run)(const adit::MapArguments&)) {
    CLI::App* sub = command->add_subcommand(name, text);
    sub->add_option("plan", args.plan, "the plan's file")->required();
    sub->callback([&action, &args, run] { action = [&args, run] { return run(args); }; });
    return sub;
  };
  add("info", "Extent, lengths and counts of a plan", adit::run_map_info);
  add("check",
      "What is wrong with a plan, and what cleaning does to it; exit 1 if it needs cleaning",
      adit::run_map_check);
  add("convert", "Write the cleaned plan in another form", adit::run_map_convert)
      ->add_option("-o,--output", args.output, "the file to write (.csv)")
      ->required();
  add_aliases(command, aliases, action);
}

void add_plot(CLI::App& app, adit::PlotArguments& args, Action& action) {
  CLI::App* command =
      app.add_subcommand("plot", "Draw a PNG, SVG or PDF, by the ending of the output");
  command->require_subcommand(1);
  const auto add = [&](const char* name, const char* text, int (*run)(const adit::PlotArguments&)) {
    CLI::App* sub = command->add_subcommand(name, text);
    sub->add_option("-o,--output", args.output, "the picture's file")->required();
    sub->add_option("--config", args.config, "TOML file; see 'adit config --reference'");
    sub->callback([&action, &args, run] { action = [&args, run] { return run(args); }; });
    return sub;
  };
  const auto map = [&](CLI::App* sub) {
    sub->add_option("--map", args.map, "plan, in metres")->required();
  };
  const auto scan = [&](CLI::App* sub) {
    sub->add_option("--scan", args.scan, "LOG:INDEX, counting scans from 0")->required();
  };
  const auto pose = [&](CLI::App* sub) {
    sub->add_option("--pose", args.pose, "x,y,heading in m, m, degrees")->required();
  };
  map(add("map", "The cleaned plan", adit::run_plot_map));
  scan(add("scan", "A scan with its extracted features", adit::run_plot_scan));
  CLI::App* features = add("features", "What the map shows from a pose", adit::run_plot_features);
  map(features);
  pose(features);
  CLI::App* match =
      add("match", "A scan on the map at a pose, with numbered pairs", adit::run_plot_match);
  map(match);
  scan(match);
  pose(match);
  CLI::App* trajectory = add("trajectory", "A trajectory on the map", adit::run_plot_trajectory);
  map(trajectory);
  trajectory->add_option("--trajectory,--estimate", args.trajectory, "TUM file or estimates.csv")
      ->required();
  trajectory->add_option("--truth", args.truth, "TUM file to draw beside it");
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("adit: where is this machine in the mine, how sure is that, and can it be trusted?",
               "adit");
  app.set_version_flag("--version", ADIT_VERSION);
  app.require_subcommand(1);
  adit::DemoArguments demo;
  adit::SimulateArguments simulate;
  adit::LocalizeArguments localize;
  adit::LocateArguments locate;
  adit::EvaluateArguments evaluate;
#ifdef ADIT_WITH_SURVEY
  adit::SurveyArguments survey;
#endif
  adit::MapArguments map;
  adit::AliasesArguments aliases;
  adit::PlotArguments plot;
  bool reference = false;
  Action action;
  add_demo(app, demo, action);
  add_simulate(app, simulate, action);
  add_localize(app, localize, action);
  add_locate(app, locate, action);
  add_evaluate(app, evaluate, action);
#ifdef ADIT_WITH_SURVEY
  add_survey(app, survey, action);
#endif
  add_map(app, map, aliases, action);
  add_plot(app, plot, action);
  CLI::App* config =
      app.add_subcommand("config", "Print a configuration file with every key at its default");
  config->add_flag("--reference", reference, "print the reference page (Markdown) instead");
  config->callback([&] { action = [&] { return adit::run_config(reference); }; });

  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    const int status = app.exit(error);
    return status == 0 ? 0 : kWrongCall;
  }
  try {
    return action();
  } catch (const std::exception& error) {
    std::fprintf(stderr, "adit: %s\n", error.what());
    return adit::kFailed;
  }
}
