#pragma once

#include <span>
#include <vector>

#include "adit/localizer/localizer.hpp"
#include "adit/simulation/vehicle.hpp"
#include "trial_options.hpp"

namespace adit {

/// One seed's world, the vehicle in it, and what the localizer is told of both.
struct TrialScene {
  World world;
  ScannerSpec scanner;
  DriveOptions drive;
  bool stops = false;
  std::vector<Vector2d> intersections;  ///< middles of the openings that cross the way, if known
  int clutter = 0;                      ///< pieces that found room
  LocalizerSettings settings;
};

/// The scene that the trial states, with its scanner's faults; what befalls the plan or the vehicle
/// comes later. The stated plan error is that of the plan before.
TrialScene make_scene(const TrialOptions& options, std::uint64_t seed);

/// What the vehicle brings home from a part of the path, or from all of it.
Recording record(const TrialScene& scene, std::span<const Pose2> path, std::uint64_t seed);

/// Tells the localizer how far walls stand from the plan (m).
void state_map_sigma(double sigma_m, LocalizerSettings& settings);

}  // namespace adit
