#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace adit {

/// Where a cell is driven. The panels of equal pillars have a mark that tells their sides apart, or
/// none.
enum class Mine {
  niosh,
  edgar,
  panel,
  mockup,
  crosscuts,
  straight,
  regular_panel,
  gap_panel,
  entry_panel
};

/// What the mine has otherwise than its plan.
enum class PlanError {
  none,
  bent,           ///< by `bend_m` over 8 m, rough by 0.05 m
  ends_off,       ///< the ends of walls by `bend_m`, each by itself; those that meet still do
  missing_added,  ///< 5 % of the walls too few and too many, bent besides
  chains,         ///< single chains of wall as a whole, bent besides
  distorted,      ///< the whole by 0.2 %, bent besides
  off_plan,       ///< the plan lacks a circle of 30 m round the middle of the drive, bent besides
  rough,          ///< as `panel` and the straight drift are simulated: 0.15 m over 1.5 m
  wall_moved,     ///< one wall is drawn 1 m off
  pillar          ///< a pillar too few or too many
};

/// What stands about or moves.
enum class Clutter { none, five, eight, twelve, twenty, leaning, walkers, machine_ahead };

/// What dead reckoning does. `usual` is what the configuration declares: 2 % and 0.5°/m from scan
/// to scan, and 1 % lastingly; `paper` 5 % and 1.25°/m, also where wheels slip in bursts.
enum class Wheels {
  usual,
  paper,
  paper_bursts,
  longer,
  shorter,
  turns_more,
  gap_3_s,
  gap_8_s,
  frozen,
  creeping,
  slip_bursts,
  jumping,
  none
};

/// What is wrong with the scanner.
enum class ScannerFault {
  none,
  repeats,
  mirrored,
  turned,
  lever_arm,
  self_hits,
  ramps,
  one_of_two,
  dust,
  dropouts
};

/// What the estimator is told of the first pose.
enum class Start { right, anywhere, carried_off, typed_wrong };

/// What is done in the cell.
enum class Task {
  drive,    ///< 60 m at 1 m/s, five scans a second
  stops,    ///< the world's own path, a scan at each stop
  locate,   ///< 20 single scans at places of the mine are looked for, with nothing known
  outside,  ///< the same with scans of a mine that is not the plan's
};

/// One line of the campaign's table; what it does not name is as here.
struct Cell {
  std::string_view name;
  std::string_view group;
  Mine mine = Mine::niosh;
  PlanError plan = PlanError::none;
  double bend_m = 0.15;
  double stated_m = 0.15;  ///< `[map] sigma_m`
  std::string_view scanner = "sick";
  Clutter clutter = Clutter::five;
  Wheels wheels = Wheels::usual;
  ScannerFault fault = ScannerFault::none;
  Start start = Start::right;
  Task task = Task::drive;
  int quick = 0;  ///< drives of `campaign quick`
  int full = 40;  ///< drives of `campaign full`
};

/// The campaign's table.
std::span<const Cell> all_cells();

/// The seed of a drive: of the campaign's, the cell's name and the drive's number.
std::uint64_t seed_of(const Cell& cell, std::uint64_t base, std::int64_t drive);

/// What the cell's line says beside the numbers of drives, for the fingerprint of its results.
std::string text_of(const Cell& cell);

}  // namespace adit
