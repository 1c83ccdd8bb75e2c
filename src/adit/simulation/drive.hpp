#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "adit/simulation/drive_map.hpp"
#include "adit/simulation/timed_path.hpp"

namespace adit {

/// A drive from pose to pose. A pose that equals the one before is a stop, one that differs in its
/// heading alone a turn on the spot.
struct Drive {
  std::vector<Pose2> poses;     ///< map_from_vehicle
  std::vector<double> least_s;  ///< time that the move to each pose takes at least (s); else 0

  /// Way driven (m).
  double length_m() const;
};

/// The drive from time 0: each move as slow as the speed (m/s), the turn rate (rad/s) or its least
/// time demands.
TimedPath timed(const Drive& drive, double speed, double turn_rate);

/// What a random drive is like.
struct RandomDriveOptions {
  double length_m = 120.0;
  double step_m = 0.45;
  int stops = 0;
  double stop_s = 5.0;
  int turns = 0;
  int creeps = 0;
  double creep_m_per_s = 0.05;

  template <class Self, class Field>
  static void visit(Self& self, Field&& field) {
    field("length_m", self.length_m, "way driven (m)");
    field("step_m", self.step_m, "from pose to pose, at most (m)");
    field("stops", self.stops, "places at which the machine stands for a while");
    field("stop_s", self.stop_s, "how long, within a half of it (s)");
    field("turns", self.turns, "places at which it turns right round on the spot");
    field("creeps", self.creeps, "steps that it creeps instead of driving");
    field("creep_m_per_s", self.creep_m_per_s, "how fast it creeps (m/s)");
  }
};

/// A drive to places chosen at random, one after the other, along the middle of the openings and on
/// without going back. At a dead end the machine turns on the spot. Every pose and the straight way
/// to it keep the map's clearance; corners are rounded as far as that allows.
///
/// It begins at `start`, by a turn on the spot where that looks another way, else at a random
/// place. Empty where the map is, or where no clear piece leads from the start to a place of it.
Drive random_drive(const DriveMap& map, const RandomDriveOptions& options, std::uint64_t seed,
                   const std::optional<Pose2>& start = std::nullopt);

/// The drive from one place to another, in the same manner, headings along the way. Empty where no
/// way leads there.
Drive drive_between(const DriveMap& map, const Vector2d& from, const Vector2d& to,
                    double step_m = 0.45);

}  // namespace adit
