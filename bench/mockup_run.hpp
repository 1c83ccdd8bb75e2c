#pragma once

#include "adit/localizer/localizer.hpp"
#include "adit/simulation/clutter.hpp"
#include "adit/simulation/vehicle.hpp"

namespace adit {

/// The paper's run with the Cyclone and eight pieces of clutter, and the settings to localise it
/// with.
struct MockupRun {
  explicit MockupRun(std::uint64_t seed, int clutter = 8) {
    world.path = mockup_path();
    add_clutter(world, clutter_of(clutter), seed);
    recording = record_stops(world, world.path, cyclone(), drive, seed);
    settings.scanner = cyclone().model;
    settings.odometry = drive.odometry;
    settings.map.sigma_m = 0.0;  // the mockup's plan is exact
  }

  World world = mockup();
  DriveOptions drive;
  Recording recording;
  LocalizerSettings settings;
};

}  // namespace adit
