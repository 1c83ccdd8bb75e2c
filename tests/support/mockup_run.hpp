#pragma once

#include <cstdint>
#include <vector>

#include "adit/localizer/localizer.hpp"
#include "adit/simulation/clutter.hpp"
#include "adit/simulation/vehicle.hpp"

namespace adit::test {

/// The paper's mockup with the path of its run, and so many pieces of clutter beside it.
inline World cluttered_mockup(std::uint64_t seed, int clutter) {
  World world = mockup();
  world.path = mockup_path();
  add_clutter(world, clutter_of(clutter), seed);
  return world;
}

/// The paper's run through its mockup as one seed makes it, with pieces of clutter.
inline Recording record_mockup(std::uint64_t seed, int clutter) {
  const World world = cluttered_mockup(seed, clutter);
  return record_stops(world, world.path, cyclone(), DriveOptions{}, seed);
}

/// What is known of that scanner and vehicle, and of a plan that is exact.
inline LocalizerSettings mockup_settings() {
  LocalizerSettings settings;
  settings.scanner = cyclone().model;
  settings.odometry = DriveOptions{}.odometry;
  settings.map.sigma_m = 0.0;
  return settings;
}

}  // namespace adit::test
