#pragma once

// What makes a drive of a cell, one function for each thing that may differ. A new kind of fault is
// one more function here, and one more word in cell.hpp.

#include "scene.hpp"

namespace adit {

/// Chooses the drive (`path`, `after`) in the planned mine. False: there is none.
bool choose_way(const Cell& cell, std::uint64_t seed, std::int64_t drive, Scene& scene);

/// Makes the mine differ from its plan. False: the change finds no place.
bool apply_plan_error(const Cell& cell, std::uint64_t seed, Scene& scene);

/// What the plan may lack, or have too much, beside the drive; after the way is known.
void add_things(const Cell& cell, std::uint64_t seed, Scene& scene);

/// What is wrong with dead reckoning, before the drive is recorded; `drive_s` is how long it takes.
OdometryFaults wheel_faults(Wheels wheels, double drive_s, std::uint64_t seed);

/// Within so much of a place (m) the plan has nothing, where it lacks a part: 30 m across.
inline constexpr double kOffPlanRadius = 15.0;

/// The scanners as they are: the one that is declared and what is wrong with it, or two, both
/// declared, of which the second fails.
std::vector<ScannerSpec> faulty_scanners(const Cell& cell, double drive_s);

/// What the estimator is told of the first pose.
bool choose_start(const Cell& cell, std::uint64_t seed, Scene& scene);

}  // namespace adit
