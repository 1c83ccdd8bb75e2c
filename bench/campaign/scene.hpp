#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "adit/localizer/localizer.hpp"
#include "adit/simulation/vehicle.hpp"
#include "grounds.hpp"

namespace adit {

/// One drive of a cell, made ready: the mine, what the machine brings home from it, and what the
/// estimator is given.
struct Scene {
  std::shared_ptr<const Ground> ground;
  World world;  ///< the mine as it is; its plan is the one that the estimator has
  /// Of a plan that is this drive's alone, with its index.
  std::shared_ptr<const LineMap> own_map;
  std::shared_ptr<const PlaceIndex> own_index;
  std::vector<ScannerSpec> scanners;  ///< as they err; the first is never the one of two that fails
  DriveOptions drive;
  LocalizerSettings settings;
  std::vector<Pose2> path;          ///< of the drive
  std::vector<double> least_s;      ///< that the move to each pose of it takes (s); empty for none
  std::vector<Pose2> after;         ///< where the machine is carried off to, and drives on
  std::optional<Vector2d> missing;  ///< the middle of what the plan lacks
  Recording recording;
  std::optional<PoseWithCovariance> start;  ///< none: it may be anywhere
  std::size_t fault_at = 0;  ///< the scan from which the pose is sought and the oracle counts
  std::optional<std::size_t> news_at;  ///< likewise, where a mark comes in sight later

  TimedPath timed_path() const;
  const ScannerSpec& scanner() const { return scanners.front(); }
  const LineMap& map() const { return own_map ? *own_map : ground->map; }
  const std::shared_ptr<const PlaceIndex>& index() const {
    return own_map ? own_index : ground->index;
  }
};

/// The drive of a cell. Error: its plan cannot be read, or its fault finds no place in this drive.
Result<Scene> make_scene(const Cell& cell, Grounds& grounds, std::uint64_t base_seed,
                         std::int64_t drive);

/// The settings that the estimator is given in the cell.
LocalizerSettings settings_of(const Cell& cell);

/// The noise of dead reckoning that is simulated and declared.
OdometryNoise noise_of(Wheels wheels);

}  // namespace adit
