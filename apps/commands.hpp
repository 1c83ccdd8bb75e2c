#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace adit {

/// Exit statuses: done, the work failed (what and where on stderr), the call was wrong.
inline constexpr int kDone = 0;
inline constexpr int kFailed = 1;
inline constexpr int kWrongCall = 2;

struct DemoArguments {
  std::string output = "adit-demo";
  std::uint64_t seed = 1992;
};

struct SimulateArguments {
  std::string world;
  std::string output;
  std::string config;
  std::string path;
  std::string scanner = "cyclone";
  std::uint64_t seed = 1;
  int clutter = 0;
  std::string clutter_kind = "free";
  int ramps = 0;
  std::optional<double> machine_ahead;  ///< m
  std::optional<std::string> as_built;  ///< key=number,…
  std::vector<double> off_plan;         ///< x, y, radius (m)
  std::optional<double> speed;
  std::optional<double> sweep;
  std::vector<double> odometry;  ///< ratio, degrees per metre, ratio of turns
  std::optional<double> drive;   ///< m, at random through the openings
  int stops = 0;
  int turns = 0;
  int creeps = 0;
  std::vector<std::string> faults;  ///< key=number
};

struct LocalizeArguments {
  std::string map;
  std::string log;
  std::optional<std::string> start;  ///< x,y,heading in degrees, or "anywhere"
  std::string resume;                ///< last_pose.json of an earlier run
  std::vector<double> moved;         ///< since then, one sigma: m, degrees
  std::string level;                 ///< of a plan with levels
  std::optional<int> threads;
  std::string index;  ///< a file; empty: none
  std::string config;
  std::string output = "adit-localize";
  std::string estimator = "full";
};

struct LocateArguments {
  std::string map;
  std::string scan;  ///< LOG:INDEX or LOG:all
  std::string config;
  std::string index;           ///< a file; empty: none
  std::string output;          ///< a picture
  std::optional<int> threads;  ///< none: one searches, all cores make the index
  bool json = false;
};

struct EvaluateArguments {
  std::string estimate;
  std::string truth;
  std::string relations;
  bool json = false;
};

struct SurveyArguments {
  std::string log;
  std::string poses;                 ///< known positions; empty: there are none
  std::string update;                ///< a plan to compare with; empty: none
  std::string apply;                 ///< which changes: "all" or numbers; empty: none
  std::optional<std::string> start;  ///< in that plan: x,y,heading in degrees
  std::string trajectory;            ///< where to write the poses; empty: nowhere, as the next
  std::string walls;
  std::string report;
  std::string picture;
  std::optional<int> threads;
  std::string config;
  std::string output;
};

struct MapArguments {
  std::string plan;
  std::string output;
};

struct AliasesArguments {
  std::string plan;
  std::string scanner = "cyclone";
  std::optional<double> pitch;  ///< m; none: by the number of places
  std::optional<int> threads;
  std::string config;
  std::string output;  ///< a picture
};

struct PlotArguments {
  std::string map;
  std::string scan;  ///< LOG:INDEX
  std::string pose;  ///< x,y,heading in degrees
  std::string trajectory;
  std::string truth;
  std::string config;
  std::string output;
};

int run_demo(const DemoArguments& arguments);
int run_simulate(const SimulateArguments& arguments);
int run_localize(const LocalizeArguments& arguments);
int run_locate(const LocateArguments& arguments);
/// What `estimator` may be.
std::vector<std::string> estimator_names();
int run_evaluate(const EvaluateArguments& arguments);
int run_survey(const SurveyArguments& arguments);
int run_map_info(const MapArguments& arguments);
int run_map_check(const MapArguments& arguments);
int run_map_convert(const MapArguments& arguments);
int run_map_aliases(const AliasesArguments& arguments);
int run_plot_map(const PlotArguments& arguments);
int run_plot_scan(const PlotArguments& arguments);
int run_plot_features(const PlotArguments& arguments);
int run_plot_match(const PlotArguments& arguments);
int run_plot_trajectory(const PlotArguments& arguments);
/// Prints the reference of the configuration file (Markdown), or its defaults (TOML).
int run_config(bool reference);

}  // namespace adit
