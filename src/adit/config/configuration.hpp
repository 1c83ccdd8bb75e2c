#pragma once

#include <set>
#include <string>
#include <string_view>

#include "adit/geometry/result.hpp"
#include "adit/localizer/localizer.hpp"
#include "adit/map/line_map.hpp"
#include "adit/survey/drive_options.hpp"
#include "adit/survey/known_positions.hpp"
#include "adit/survey/plan_difference.hpp"
#include "adit/survey/wall_options.hpp"

namespace adit {

/// [matching] consistency: which definition of a consistent set the matching takes.
struct ConsistencyChoice {
  MatchingOptions& matching;

  template <class Self, class Field>
  static void visit(Self& self, Field&& field) {
    field("consistency", self.matching.consistency, "when a set of pairs is consistent");
  }
};

/// Everything that a configuration file can say. To extend it by a stage, add the stage's Options
/// and one line to `visit`; an enumeration among its fields also needs its words in enum_names.hpp.
struct Configuration {
  LocalizerSettings localizer;
  LineMapOptions map;
  DriveSurveyOptions drive;  ///< of a survey, as are the next
  WallOptions walls;
  KnownPositionsOptions positions;
  PlanDifferenceOptions changes;

  /// Names each table: `table(name, options, documentation)`, where options has a `visit` of its
  /// own. Two parts may share a table.
  template <class Table>
  static void visit(Configuration& self, Table&& table) {
    ConsistencyChoice consistency{self.localizer.matching};
    table("scanner", self.localizer.scanner, "how the scanner measures");
    table("odometry", self.localizer.odometry, "how wrong dead reckoning may be");
    table("map", self.localizer.map, "");
    table("map", self.map, "the plan and its cleaning");
    table("motion", self.localizer.motion, "how the vehicle moves during a sweep");
    table("deskew", self.localizer.deskew, "what of a sweep is out of sight from one place");
    table("prediction", self.localizer.prediction, "which features the plan promises");
    table("extraction", self.localizer.extraction, "which features a scan shows");
    table("matching", consistency, "");
    table("matching", self.localizer.matching, "which of them are the same");
    table("estimation", self.localizer.estimation, "the pose that follows");
    table("belief", self.localizer.belief, "which feature estimates are believed");
    table("refinement", self.localizer.refinement, "all points against the plan");
    table("beams", self.localizer.refinement.priors,
          "what a beam may meet, for fits and searches alike");
    table("search", self.localizer.search, "where else to look when they do not fit");
    table("displacement", self.localizer.displacement,
          "returns that look like a wall in the wrong place");
    table("tracking", self.localizer.tracking, "scans and dead reckoning together");
    table("status", self.localizer.status, "when a pose may be trusted");
    table("stamps", self.localizer.stamps, "what is odd in the order of scans");
    table("protection", self.localizer.protection, "how far off a trusted pose may be");
    table("localizer", self.localizer.localizer, "the start, and what holds between two scans");
    table("recovery", self.localizer.recovery, "when a lost pose is looked for in the whole mine");
    table("hypotheses", self.localizer.hypotheses, "which of several poses is believed, and when");
    table("places", self.localizer.places, "the index of places where a scanner may stand");
    table("relocation", self.localizer.relocation, "how a scan is looked for in the whole mine");
    table("likelihood", self.localizer.likelihood, "what a scan says of a pose found there");
    table("survey_surfaces", self.drive.surface, "how scans become points of walls");
    table("survey_alignment", self.drive.alignment, "how points are laid onto others");
    table("survey_tracking", self.drive.tracking, "how a drive is followed from scan to scan");
    table("survey_loops", self.drive.loops, "how places that were seen before are found");
    table("survey_joint", self.drive.joint, "how all scans are laid onto each other");
    table("survey_known_places", self.drive.known_places,
          "how a drive is brought into the frame of a plan that is updated");
    table("survey_walls", self.walls, "how walls are drawn");
    table("survey_positions", self.positions, "how scans from known positions are turned");
    table("survey_changes", self.changes, "when a plan and a survey are the same");
  }
};

/// A configuration and the keys ("table.key") that its file gave: what it did not give is for the
/// log to say.
struct LoadedConfiguration {
  Configuration values;
  std::set<std::string> given;

  bool has(const std::string& key) const { return given.contains(key); }
};

/// Reads a configuration in TOML over `base`. Errors name the line and what was expected: no
/// TOML, an unknown table or key (with the nearest known ones), a wrong type or word, a number that
/// is not finite, negative, or less than its key can be, a maximum range that is not above the
/// minimum.
Result<LoadedConfiguration> read_configuration(const std::string& path,
                                               const Configuration& base = {});

/// The same from text, which may be empty; `file` is the name in errors.
Result<LoadedConfiguration> parse_configuration(std::string_view text, const std::string& file = {},
                                                const Configuration& base = {});

/// The configuration as TOML, each key under its documentation. `only` names the tables ("scanner")
/// and keys ("scanner.sweep_s") to write; empty for all.
std::string format_configuration(const Configuration& configuration,
                                 const std::set<std::string>& only = {});

/// Writes `format_configuration` to a file, whole or not at all.
Result<void> write_configuration(const Configuration& configuration, const std::string& path,
                                 const std::set<std::string>& only = {});

/// All tables, keys, defaults and meanings as a page of Markdown.
std::string configuration_reference();

}  // namespace adit
