#pragma once

// What makes a drive of a cell, one function for each thing that may differ. A new kind of fault is
// one more function here, and one more word in cell.hpp.

#include "scene.hpp"

namespace adit {

/// A drive of so many metres from a place that keeps clear of the walls: on where there is room,
/// else towards the most of it.
std::vector<Pose2> roam(const RayCaster& walls, const Pose2& start, double metres);

/// Chooses the drive (`path`, `after`) in the planned mine. False: there is none.
bool choose_way(const Cell& cell, std::uint64_t seed, std::int64_t drive, Scene& scene);

/// Makes the mine differ from its plan. False: the change finds no place.
bool apply_plan_error(const Cell& cell, std::uint64_t seed, Scene& scene);

/// What the plan may lack, or have too much, beside the drive; after the way is known.
void add_things(const Cell& cell, std::uint64_t seed, Scene& scene);

/// Spoils the recorded odometry.
void spoil_wheels(const Cell& cell, std::uint64_t seed, Scene& scene);

/// Within so much of a place (m) the plan has nothing, where it lacks a part.
inline constexpr double kOffPlanRadius = 15.0;

/// Mounts the scanner as it is, before the drive is recorded.
void mount_scanner(const Cell& cell, Scene& scene);

/// Spoils the recorded scans.
void spoil_scans(const Cell& cell, std::uint64_t seed, Scene& scene);

/// What the estimator is told of the first pose.
bool choose_start(const Cell& cell, std::uint64_t seed, Scene& scene);

}  // namespace adit
