#pragma once

#include <memory>
#include <optional>

#include "adit/localizer/belief.hpp"
#include "adit/localizer/dead_reckoner.hpp"
#include "adit/localizer/fitter.hpp"
#include "adit/localizer/judge.hpp"
#include "adit/localizer/settings.hpp"
#include "adit/localizer/sweep.hpp"
#include "adit/localizer/timings.hpp"
#include "adit/localizer/turn.hpp"
#include "adit/map/line_map.hpp"
#include "adit/tracking/estimate.hpp"

namespace adit {

/// The paper's cycle (Fig. 1): scan after scan, where the vehicle is in the map.
///
/// Deterministic: the same calls give the same bits. After the first scans it allocates nothing,
/// unless it is lost. The map must outlive the localizer.
class Localizer {
 public:
  /// With an index of the map's places a lost pose is looked for at once; without one, the first
  /// search makes it.
  Localizer(const LineMap& map, const LocalizerSettings& settings,
            std::shared_ptr<const PlaceIndex> places = nullptr);
  Localizer(LineMap&& map, const LocalizerSettings& settings,
            std::shared_ptr<const PlaceIndex> places = nullptr) = delete;
  Localizer(const Localizer&) = delete;  // estimates view its buffers
  Localizer& operator=(const Localizer&) = delete;
  ~Localizer() = default;

  /// Says where the vehicle is at the next scan, and how surely (default: the start sigmas).
  /// Forgets all else, what was fed as well. A start that is not finite is ignored.
  void start(const Pose2& map_from_vehicle,
             const std::optional<Matrix3d>& covariance = std::nullopt);

  /// The vehicle may be anywhere in the mine: the next scan is looked for in all of it. `lost`
  /// until something is found, `ambiguous` while several poses explain the scans. Needs all points
  /// (`full` or `points`) and `[recovery] searches`.
  void start_anywhere();

  /// Feeds dead reckoning: stamped poses in the odometry's frame, of which only differences count.
  void add_odometry(const StampedPose& odom_from_vehicle);

  /// Feeds a gyro's heading (rad) at a stamp; its differences replace the odometry's rotation.
  void add_gyro(double stamp, double heading);

  /// One turn of the cycle, with dead reckoning taken from what was fed, at the scan's stamp; with
  /// none near it the pose becomes unsure with the time since the last scan, and a pose that a scan
  /// has contradicted is not trusted again, for nobody knows the way.
  const Estimate& update(const LaserScan& scan);

  /// One turn of the cycle, with the odometry pose that came with the scan. A pose or a mounting
  /// that is not finite makes the scan unusable: it is answered `lost`, and the next one as ever.
  const Estimate& update(const LaserScan& scan, const Pose2& odom_from_vehicle);

  const Estimate& estimate() const { return estimate_; }

  /// What the last turn worked with; holds until the next.
  Turn last_turn() const;

 private:
  const Estimate& turn(const LaserScan& scan, const std::optional<Pose2>& odom_from_vehicle);
  const Estimate& skip(double stamp);
  void begin_turn();
  void hold_against_all(const Sweep& sweep, const Motion& motion);
  double moved_since(const Pose2& map_from_vehicle) const;

  LocalizerSettings settings_;
  DeadReckoner reckoner_;
  SweepUndoer undoer_;
  Fitter fitter_;
  Belief belief_;
  Judge judge_;
  Fits fits_;
  Timings timings_;
  Estimate estimate_;
};

}  // namespace adit
