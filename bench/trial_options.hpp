#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "adit/geometry/result.hpp"
#include "adit/localizer/localizer.hpp"

namespace adit {

/// Where a trial is held. `sweep` and `sweep_panel` are of their own kind: moving against standing.
enum class TrialWorld { mockup, panel, drift, drift_rough, straight, sweep, sweep_panel, stress };

/// Scan after scan with odometry, or each scan alone from a guess of its own.
enum class TrialMode { tracking, single };

/// While the odometry's error stays what it is: from stamp to stamp, so that it changes in the
/// middle of a sweep, or sweep by sweep.
enum class ErrorSpan { stamps, sweeps };

/// The words of an enumeration's values, in their order.
template <class Enum>
inline constexpr std::array<std::string_view, 0> kWords{};
template <>
inline constexpr auto kWords<TrialWorld> = std::to_array<std::string_view>(
    {"mockup", "panel", "drift", "drift_rough", "straight", "sweep", "sweep_panel", "stress"});
template <>
inline constexpr auto kWords<TrialMode> = std::to_array<std::string_view>({"tracking", "single"});
template <>
inline constexpr auto kWords<ErrorSpan> = std::to_array<std::string_view>({"stamps", "sweeps"});
template <>
inline constexpr auto kWords<Estimator> = std::to_array<std::string_view>({"features", "points",
                                                                           "full"});

/// The word of a value.
template <class Enum>
std::string_view word_of(Enum value) {
  return kWords<Enum>[static_cast<std::size_t>(value)];
}

/// One trial, as the command line states it in words `name=value`.
struct TrialOptions {
  TrialWorld world = TrialWorld::mockup;
  std::string scanner = "cyclone";
  TrialMode mode = TrialMode::tracking;
  Estimator estimator = Estimator::full;
  ErrorSpan errors = ErrorSpan::sweeps;
  int runs = 60;
  int answers = 0;
  std::uint64_t seed = 1;
  int clutter = 0;
  std::optional<double> speed;
  std::string map_sigma = "plan";
  int worst = 0;

  template <class Self, class Field>
  static void visit(Self& self, Field&& field) {
    field("world", self.world, "where; sweep and sweep_panel compare moving with standing");
    field("scanner", self.scanner, "cyclone, sick, sick_lms or hokuyo");
    field("mode", self.mode, "with odometry from scan to scan, or each scan alone");
    field("estimator", self.estimator, "what says where the vehicle is");
    field("errors", self.errors,
          "of a sweep world's odometry are steady from stamp to stamp or through each sweep");
    field("runs", self.runs, "seeds, one a run");
    field("answers", self.answers, "above 0: as many seeds as make so many answers");
    field("seed", self.seed, "the first seed");
    field("clutter", self.clutter, "pieces of it");
    field("speed", self.speed,
          "of the drive (m/s); 0 stops at each pose of the path. Usual are 0 in the mockup and for "
          "single scans, else 1");
    field("map_sigma", self.map_sigma,
          "what the localizer is told of the plan's error (m): `plan` for the true one, `unknown` "
          "for nothing, or a number");
    field("worst", self.worst, "lists so many of the ok or degraded answers that err most");
  }

  /// The number that `map_sigma` gives, if it is one.
  std::optional<double> stated_map_sigma() const;
  bool stops() const;
};

/// Reads the words of a command line; the error says which word is wrong and what was expected.
Result<TrialOptions> parse_trial(std::span<char* const> words);

/// All names, their defaults and meanings, a line each.
std::string trial_usage();

/// The trial as one line of words, by which it can be repeated.
std::string to_text(const TrialOptions& options);

}  // namespace adit
