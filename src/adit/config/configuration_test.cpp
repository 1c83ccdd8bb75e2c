#include "adit/config/configuration.hpp"

#include <gtest/gtest.h>

#include "adit/config/fields.hpp"
#include "support/test_files.hpp"

namespace adit {
namespace {

constexpr int kBoundedKeys = 83;  // that cannot be 0

LoadedConfiguration loaded(std::string_view text) {
  auto read = parse_configuration(text, "c.toml");
  EXPECT_TRUE(read) << to_string(read.error());
  return read ? *read : LoadedConfiguration{};
}

std::string error_of(std::string_view text) {
  const auto read = parse_configuration(text, "c.toml");
  return read ? "no error" : to_string(read.error());
}

TEST(Configuration, KeysOfTheInterfaceReachTheirStages) {
  const LoadedConfiguration read = loaded(R"(
    [scanner]
    range_sigma_m = 0.1
    quantisation_m = 0.2
    bearing_sigma_rad = 0.001
    max_range_m = 50
    sweep_s = 0.1
    stamp = "middle"
    [odometry]
    translation_sigma_ratio = 0.05
    rotation_sigma_rad_per_m = 0.03
    rotation_sigma_ratio = 0.04
    [map]
    sigma_m = 0.07
    snap_m = 0.02
  )");
  const LocalizerSettings& settings = read.values.localizer;
  EXPECT_EQ(settings.scanner.range_sigma_m, 0.1);
  EXPECT_EQ(settings.scanner.quantisation_m, 0.2);
  EXPECT_EQ(settings.scanner.bearing_sigma_rad, 0.001);
  EXPECT_EQ(settings.scanner.max_range_m, 50.0);
  EXPECT_EQ(settings.scanner.sweep_s, 0.1);
  EXPECT_EQ(settings.scanner.stamp, SweepMoment::middle);
  EXPECT_EQ(settings.odometry.translation_sigma_ratio, 0.05);
  EXPECT_EQ(settings.odometry.rotation_sigma_rad_per_m, 0.03);
  EXPECT_EQ(settings.odometry.rotation_sigma_ratio, 0.04);
  EXPECT_EQ(settings.map.sigma_m, 0.07);
  EXPECT_EQ(read.values.map.snap_m, 0.02);
  EXPECT_EQ(read.given.size(), 11u);
  EXPECT_TRUE(read.has("scanner.max_range_m"));
  EXPECT_TRUE(read.has("map.sigma_m"));
  EXPECT_FALSE(read.has("scanner.min_range_m"));
}

TEST(Configuration, EveryStageHasATable) {
  const LoadedConfiguration read = loaded(
      "matching.consistency = \"paper\"\nestimation.weighting = \"points\"\n"
      "estimation.max_iterations = 7\n[prediction]\nmin_line_m = 0.6\n[extraction]\n"
      "min_line_m = 0.7\n[belief]\nmin_pairs = 4\n[motion]\nspeed_sigma_m_per_s = 1.5\n[deskew]\n"
      "surface_beams = 5\n[beams]\nlong_ratio = 0.2\n[search]\nreach_sigmas = 3\n"
      "[displacement]\nmost_m = 1.5\n[tracking]\nbias_distance_m = 12\n[status]\n"
      "ambiguous_gain = 2\n[stamps]\ngap_s = 1\n[protection]\nrisk = 0.01\n[localizer]\n"
      "start_sigma_m = 0.5\n");
  EXPECT_EQ(read.values.localizer.matching.consistency, Consistency::paper);
  EXPECT_EQ(read.values.localizer.estimation.weighting, Weighting::points);
  EXPECT_EQ(read.values.localizer.estimation.max_iterations, 7);
  EXPECT_EQ(read.values.localizer.prediction.min_line_m, 0.6);
  EXPECT_EQ(read.values.localizer.extraction.min_line_m, 0.7);
  EXPECT_EQ(read.values.localizer.belief.min_pairs, 4);
  EXPECT_EQ(read.values.localizer.motion.speed_sigma_m_per_s, 1.5);
  EXPECT_EQ(read.values.localizer.deskew.surface_beams, 5);
  EXPECT_EQ(read.values.localizer.refinement.priors.long_ratio, 0.2);
  EXPECT_EQ(read.values.localizer.search.reach_sigmas, 3.0);
  EXPECT_EQ(read.values.localizer.displacement.most_m, 1.5);
  EXPECT_EQ(read.values.localizer.tracking.bias_distance_m, 12.0);
  EXPECT_EQ(read.values.localizer.status.ambiguous_gain, 2.0);
  EXPECT_EQ(read.values.localizer.stamps.gap_s, 1.0);
  EXPECT_EQ(read.values.localizer.protection.risk, 0.01);
  EXPECT_EQ(read.values.localizer.localizer.start_sigma_m, 0.5);
}

TEST(Configuration, NothingGivenIsTheDefault) {
  for (const char* text : {"", "# nothing\n", "[scanner]\n", "\xef\xbb\xbf[scanner]\r\n"}) {
    const LoadedConfiguration read = loaded(text);
    EXPECT_TRUE(read.given.empty());
    EXPECT_EQ(format_configuration(read.values), format_configuration(Configuration{}));
  }
}

TEST(Configuration, UnknownNamesAreErrorsWithTheNearestKnown) {
  EXPECT_EQ(error_of("[scanner]\nrange_sigma_m = 1\nrange_sigma = 0.1\n"),
            "c.toml:3: unknown key \"range_sigma\" in [scanner]; nearest known: range_sigma_m, "
            "max_range_m, min_range_m");
  EXPECT_EQ(error_of("\n\n[scaner]\nrange_sigma_m = 1\n"),
            "c.toml:3: unknown table \"scaner\"; nearest known: scanner, search, status");
  EXPECT_NE(error_of("angerr = 0.1\n").find("c.toml:1: unknown key \"angerr\" outside a table"),
            std::string::npos);
  EXPECT_NE(error_of("scanner = 1\n").find("c.toml:1: unknown key \"scanner\" outside a table"),
            std::string::npos);
}

TEST(Configuration, TheFirstErrorOfTheFileIsReported) {
  EXPECT_EQ(error_of("[scanner]\nquantisation_m = -1\n[odometry]\nx = 1\n").substr(0, 9),
            "c.toml:2:");
  EXPECT_EQ(error_of("[odometry]\nx = 1\n[scanner]\nquantisation_m = -1\n").substr(0, 9),
            "c.toml:2:");
}

TEST(Configuration, WrongValuesSayWhatWasExpected) {
  const std::string number = "expected a finite number, 0 or more";
  for (const char* value :
       {"-0.1", "nan", "inf", "-inf", "\"1\"", "true", "[1]", "{a = 1}", "1979-05-27"})
    EXPECT_EQ(error_of(std::string("[scanner]\nrange_sigma_m = ") + value + "\n"),
              "c.toml:2: scanner.range_sigma_m: " + number);
  const std::string whole = "expected a whole number, 1 or more";
  for (const char* value : {"-1", "1.0", "\"1\"", "3000000000"})
    EXPECT_EQ(error_of(std::string("[estimation]\nmax_iterations = ") + value + "\n"),
              "c.toml:2: estimation.max_iterations: " + whole);
  for (const char* value : {"\"Start\"", "\"\"", "0", "true"})
    EXPECT_EQ(error_of(std::string("[scanner]\nstamp = ") + value + "\n"),
              "c.toml:2: scanner.stamp: expected \"start\" or \"middle\" or \"end\"");
}

TEST(Configuration, SomeKeysCannotBeZero) {
  for (const char* name : {"localizer.start_sigma_m",
                           "localizer.start_sigma_rad",
                           "localizer.prior_floor_m",
                           "localizer.prior_floor_rad",
                           "localizer.prior_inflation",
                           "belief.map_stretch_m",
                           "map.length_m",
                           "map.prior_metres",
                           "map.memory_metres",
                           "motion.speed_sigma_m_per_s",
                           "motion.turn_rate_sigma_rad_per_s",
                           "refinement.max_step_m",
                           "refinement.max_step_rad",
                           "refinement.station_spacing_m",
                           "search.least_reach_m",
                           "search.least_reach_rad",
                           "tracking.bias_distance_m",
                           "tracking.gate_chi_square",
                           "protection.loose_prior",
                           "extraction.min_operator_m",
                           "extraction.max_operator_m",
                           "extraction.grazing_rad",
                           "extraction.min_corner_turn_rad",
                           "extraction.corner_chi_square",
                           "survey_alignment.scale_m",
                           "survey_alignment.wall_sigma_m",
                           "survey_alignment.shared_error_points",
                           "survey_loops.cell_m",
                           "survey_loops.blur_m",
                           "survey_loops.first_limit_m",
                           "survey_loops.closure_sigma_m",
                           "survey_loops.closure_sigma_rad",
                           "survey_joint.sight_m",
                           "survey_joint.anchor_sigma_m",
                           "survey_joint.anchor_sigma_rad",
                           "survey_joint.pair_sigma_m",
                           "survey_joint.pair_sigma_rad",
                           "survey_known_places.apart_m",
                           "survey_known_places.plan_sigma_m",
                           "hypotheses.independent_way_m",
                           "places.pitch_m",
                           "places.finest_pitch_m",
                           "places.enough_places",
                           "places.most_places",
                           "relocation.corner_sigma_m",
                           "relocation.corner_cell_m",
                           "relocation.corner_cell_rad",
                           "relocation.start_m",
                           "relocation.doubt_rad",
                           "relocation.basin_m",
                           "relocation.basin_rad",
                           "survey_changes.step_m",
                           "survey_walls.cell_m",
                           "survey_walls.merge_m",
                           "survey_walls.smooth_m",
                           "survey_walls.tolerance_m"}) {
    const std::string key = name;
    for (const char* value : {"0", "0.0", "-0.0", "-1", "nan", "\"1\""})
      EXPECT_EQ(error_of("\n" + key + " = " + value + "\n"),
                "c.toml:2: " + key + ": expected a finite number above 0");
    EXPECT_EQ(error_of(key + " = 1e-9\n"), "no error") << key;
  }
  for (const auto& [name, least] : {std::pair{"extraction.min_line_points", 3},
                                    {"refinement.max_iterations", 1},
                                    {"matching.max_calls", 1},
                                    {"matching.max_candidates", 1},
                                    {"estimation.max_iterations", 1},
                                    {"survey_surfaces.most_points", 30},
                                    {"survey_alignment.max_iterations", 1},
                                    {"survey_tracking.local_keyframes", 1},
                                    {"survey_loops.query_keyframes", 1},
                                    {"survey_loops.target_keyframes", 1},
                                    {"survey_loops.query_stride", 1},
                                    {"survey_loops.target_stride", 1}}) {
    const std::string key = name;
    EXPECT_EQ(
        error_of("\n" + key + " = " + std::to_string(least - 1) + "\n"),
        "c.toml:2: " + key + ": expected a whole number, " + std::to_string(least) + " or more");
    EXPECT_EQ(error_of(key + " = " + std::to_string(least) + "\n"), "no error") << key;
  }
  EXPECT_EQ(error_of("scanner.range_sigma_m = 0\nbelief.few_pairs = 0\n"), "no error");
}

TEST(Configuration, ProbabilitiesLieBetweenZeroAndOne) {
  for (const char* name : {"beams.leave_ratio", "beams.back_ratio", "beams.long_ratio",
                           "beams.gone_ratio", "beams.dropout_ratio", "protection.risk"}) {
    const std::string key = name;
    for (const char* value : {"0", "-0.1", "1", "1.5", "inf", "nan", "\"0.1\""})
      EXPECT_EQ(error_of(key + " = " + value + "\n"),
                "c.toml:1: " + key + ": expected a number above 0 and below 1");
    EXPECT_EQ(error_of(key + " = 0.999\n"), "no error") << key;
  }
}

// A key that a check names must be a key of the configuration.
TEST(Configuration, EveryBoundBelongsToAKey) {
  Configuration defaults;
  int checked = 0;
  for (const ConfigField& field : fields_of(defaults)) {
    if (std::holds_alternative<WordField>(field.target)) continue;
    if (std::holds_alternative<bool*>(field.target)) continue;
    const std::string error = error_of(field.name() + " = 0\n");
    if (error != "no error" && field.name() != "scanner.max_range_m") ++checked;
    EXPECT_EQ(error_of(field.name() + " = " + value_text(field) + "\n"), "no error");
  }
  EXPECT_EQ(checked, kBoundedKeys);
}

TEST(Configuration, RangesMustLeaveRoom) {
  EXPECT_EQ(error_of("[scanner]\nmin_range_m = 5\nmax_range_m = 5\n"),
            "c.toml:3: expected scanner.max_range_m above scanner.min_range_m");
  EXPECT_EQ(error_of("[scanner]\nmax_range_m = 0\n"),
            "c.toml:2: expected scanner.max_range_m above scanner.min_range_m");
}

TEST(Configuration, WhatIsNoTomlNamesTheLine) {
  EXPECT_EQ(error_of("[scanner]\nrange_sigma_m 0.1\n").substr(0, 24), "c.toml:2: expected TOML:");
  EXPECT_EQ(error_of("[scanner]\nsweep_s = 1\nsweep_s = 2\n").substr(0, 24),
            "c.toml:3: expected TOML:");
  EXPECT_EQ(error_of(std::string("[scanner]\n\0\n", 12)),
            "c.toml:2: expected a text file (UTF-8), found binary data");
  EXPECT_NE(error_of(std::string(100000, '[')), "no error");
}

TEST(Configuration, WrittenFilesReadBack) {
  Configuration configuration;
  configuration.localizer.scanner.range_sigma_m = 1.0 / 3.0;
  configuration.localizer.scanner.max_range_m = 1e-7 + 1e3;
  configuration.localizer.scanner.min_range_m = 1e-7;
  configuration.localizer.scanner.stamp = SweepMoment::end;
  configuration.localizer.matching.consistency = Consistency::paper;
  configuration.localizer.map.sigma_m = 0.25;
  configuration.localizer.estimation.max_iterations = 3;
  const test::ScratchFolder folder;
  ASSERT_TRUE(write_configuration(configuration, folder.path("c.toml")));
  const auto read = read_configuration(folder.path("c.toml"));
  ASSERT_TRUE(read) << to_string(read.error());
  EXPECT_EQ(format_configuration(read->values), format_configuration(configuration));
  EXPECT_EQ(read->values.localizer.scanner.range_sigma_m, 1.0 / 3.0);
  EXPECT_EQ(read->values.localizer.scanner.stamp, SweepMoment::end);
  Configuration defaults;
  EXPECT_EQ(read->given.size(), fields_of(defaults).size());
}

TEST(Configuration, WritesWhatIsAskedFor) {
  Configuration configuration;
  configuration.localizer.scanner.max_range_m = 50.0;
  const std::string text =
      format_configuration(configuration, {"scanner.max_range_m", "map.sigma_m"});
  EXPECT_NE(
      text.find("[scanner]\n# a range at or over this is no return (m)\nmax_range_m = 50.0\n"),
      std::string::npos)
      << text;
  const LoadedConfiguration read = loaded(text);
  EXPECT_EQ(read.given, (std::set<std::string>{"scanner.max_range_m", "map.sigma_m"}));
  for (const std::string& key : loaded(format_configuration(configuration, {"scanner"})).given)
    EXPECT_EQ(key.substr(0, 8), "scanner.");
}

TEST(Configuration, EveryKeyIsDocumentedOnceAndInTheReference) {
  Configuration defaults;
  const std::string page = configuration_reference();
  std::set<std::string> names;
  for (const ConfigField& field : fields_of(defaults)) {
    EXPECT_TRUE(names.insert(field.name()).second) << field.name() << " stands twice";
    EXPECT_FALSE(field.documentation.empty()) << field.name();
    EXPECT_NE(page.find("| `" + field.key + "` | `" + value_text(field) + "` | "),
              std::string::npos)
        << field.name();
  }
  for (const ConfigTable& table : config_tables())
    EXPECT_NE(page.find("## [" + table.name + "]\n\n" + table.documentation), std::string::npos);
}

TEST(Configuration, FilesThatCannotBeReadAreErrors) {
  const test::ScratchFolder folder;
  const auto absent = read_configuration(folder.path("none.toml"));
  ASSERT_FALSE(absent);
  EXPECT_EQ(to_string(absent.error()),
            folder.path("none.toml") + ": cannot open: No such file or directory");
  EXPECT_TRUE(read_configuration(folder.write("empty.toml", "")));
}

}  // namespace
}  // namespace adit
