#include "adit/calibration/log_settings.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "adit/io/carmen.hpp"

namespace adit {
namespace {

/// How one of the lasers of a machine measures.
struct Laser {
  int number = 1;
  double sigma_m = 0.01;
  double step_m = 0.001;
  double max_range_m = 30.0;
};

/// A scan in the middle of a square room, 8 m wide.
LogScan scan_of(const Laser& laser, double stamp, std::mt19937_64& random) {
  std::normal_distribution<double> normal(0.0, laser.sigma_m);
  LogScan entry;
  entry.laser = {LaserKind::robotlaser, laser.number};
  entry.scan.stamp = stamp;
  entry.scan.first_bearing = -kPi;
  entry.scan.bearing_step = kTwoPi / 720;
  entry.scan.max_range = laser.max_range_m;
  for (std::size_t i = 0; i < 720; ++i) {
    const Vector2d beam = unit_vector(entry.scan.bearing(i));
    const double range = 4.0 / beam.cwiseAbs().maxCoeff() + normal(random);
    entry.scan.ranges.push_back(laser.step_m * std::round(range / laser.step_m));
  }
  return entry;
}

/// A log of scans of these lasers in turn, as a file would have it.
Log log_of(const std::vector<Laser>& lasers, int scans_of_each) {
  std::mt19937_64 random(4);
  Log log;
  for (int i = 0; i < scans_of_each; ++i) {
    for (const Laser& laser : lasers) log.scans.push_back(scan_of(laser, 0.1 * i, random));
  }
  const Result<Log> read = parse_log(format_carmen(log));
  EXPECT_TRUE(read) << to_string(read.error());
  return read ? *read : Log{};
}

LoadedConfiguration configured(const char* text) {
  const auto read = parse_configuration(text);
  EXPECT_TRUE(read) << to_string(read.error());
  return read ? *read : LoadedConfiguration{};
}

constexpr Laser kFine{1, 0.01, 0.001, 30.0};
constexpr Laser kCoarse{3, 0.04, 0.05, 25.0};

TEST(LogSettings, EachLaserTellsOfItself) {
  const LogSettings settled = settle({}, log_of({kFine, kCoarse}, 20));
  const LocalizerSettings& settings = settled.configuration.localizer;
  ASSERT_EQ(settings.more_scanners.size(), 1u);
  EXPECT_NEAR(settings.scanner.range_sigma_m, 0.01, 0.002);
  EXPECT_NEAR(settings.scanner.quantisation_m, 0.001, 1e-9);
  EXPECT_EQ(settings.scanner.max_range_m, 30.0);
  EXPECT_NEAR(settings.more_scanners[0].range_sigma_m, 0.04, 0.008);
  EXPECT_NEAR(settings.more_scanners[0].quantisation_m, 0.05, 1e-9);
  EXPECT_EQ(settings.more_scanners[0].max_range_m, 25.0);
  ASSERT_EQ(settled.lasers.size(), 2u);
  for (const ScannerSources& sources : settled.lasers) {
    EXPECT_EQ(sources.max_range_m, "the log's own fields");
    EXPECT_EQ(sources.quantisation_m, "estimated from the log");
    EXPECT_EQ(sources.range_sigma_m, "estimated from the log");
  }
  EXPECT_EQ(settled.sources.at("scanner.range_sigma_m"), "estimated from the log");
}

// What is learnt for a laser must be what its scans are used with, in whatever order they come.
TEST(LogSettings, ScansFindTheModelOfTheirLaser) {
  const Log log = log_of({kCoarse, kFine}, 20);
  const LocalizerSettings settings = settle({}, log).configuration.localizer;
  for (const LogScan& entry : log.scans) {
    const double expected = entry.laser.number == kFine.number ? kFine.step_m : kCoarse.step_m;
    EXPECT_NEAR(settings.scanner_of(entry.scan).quantisation_m, expected, 1e-9);
  }
}

TEST(LogSettings, AGivenKeyHoldsForAllLasers) {
  const LogSettings settled = settle(configured("[scanner]\nrange_sigma_m = 0.5\nsweep_s = 0.1\n"),
                                     log_of({kFine, kCoarse}, 20));
  const LocalizerSettings& settings = settled.configuration.localizer;
  ASSERT_EQ(settings.more_scanners.size(), 1u);
  for (const ScannerModel& scanner : {settings.scanner, settings.more_scanners[0]}) {
    EXPECT_EQ(scanner.range_sigma_m, 0.5);
    EXPECT_EQ(scanner.sweep_s, 0.1);
  }
  EXPECT_NEAR(settings.scanner.quantisation_m, 0.001, 1e-9);
  EXPECT_NEAR(settings.more_scanners[0].quantisation_m, 0.05, 1e-9);
  EXPECT_EQ(settled.lasers[1].range_sigma_m, "configuration");
  EXPECT_EQ(settled.sources.at("scanner.range_sigma_m"), "configuration");
  EXPECT_EQ(settled.sources.at("scanner.sweep_s"), "configuration");
}

TEST(LogSettings, WhatTooFewRangesDoNotShowIsTheDefault) {
  const Result<Log> log =
      parse_log("ROBOTLASER1 0 0 1 0.5 30 0.01 0 3 1.5 2 2.5 0 0 0 0 0 0 0 0 0 0 0 0 1 h 1\n");
  ASSERT_TRUE(log) << to_string(log.error());
  const LogSettings settled = settle({}, *log);
  const ScannerModel& scanner = settled.configuration.localizer.scanner;
  EXPECT_EQ(scanner.range_sigma_m, ScannerModel{}.range_sigma_m);
  EXPECT_EQ(scanner.quantisation_m, ScannerModel{}.quantisation_m);
  EXPECT_EQ(scanner.max_range_m, 30.0);
  EXPECT_EQ(settled.sources.at("scanner.range_sigma_m"), "default");
  EXPECT_EQ(settled.sources.at("extraction.roughness_m"), "default");
}

TEST(LogSettings, TheMapsErrorIsLearntWhereAllPointsAreUsed) {
  const Log log = log_of({kFine}, 2);
  LoadedConfiguration loaded;
  EXPECT_EQ(settle(loaded, log).sources.at("map.sigma_m"),
            "default, then learnt from the residuals");
  loaded.values.localizer.estimator = Estimator::features;
  EXPECT_EQ(settle(loaded, log).sources.at("map.sigma_m"), "default");
  loaded = configured("[map]\nsigma_m = 0.1\n");
  EXPECT_EQ(settle(loaded, log).sources.at("map.sigma_m"),
            "configuration, then learnt from the residuals");
}

}  // namespace
}  // namespace adit
