#pragma once

#include <cstddef>
#include <vector>

#include "adit/motion/odometry.hpp"
#include "adit/scan_motion/scan_motion.hpp"
#include "adit/survey/drive_options.hpp"

namespace adit {

/// A scan that the plan will be made of.
struct Keyframe {
  std::size_t scan = 0;  ///< which of the drive, from 0
  ScanShape shape;
  double beam_sigma_m = 0.0;
  Pose2 pose;                                       ///< frame_from_vehicle, as good as known now
  Pose2 previous_from_this;                         ///< by the scans, as tracked
  Matrix3d tracked_information = Matrix3d::Zero();  ///< of that, in the previous one's frame
  Pose2 odometry;                                   ///< previous_from_this by dead reckoning
  Matrix3d odometry_covariance = Matrix3d::Zero();
};

/// Where a scan stands: on the way from one keyframe to the next.
struct TrackedScan {
  std::size_t keyframe = 0;  ///< the last one before it, or itself
  Pose2 keyframe_from_scan;
  double way_m = 0.0;  ///< travelled since the first scan, turns counted as metres
};

/// Follows a drive: every scan is laid onto the last keyframes, from where dead reckoning puts it.
class ScanTracker {
 public:
  ScanTracker(const OdometryNoise& noise, const TrackingStepOptions& options,
              const SurfaceOptions& surface, const AlignmentOptions& alignment);

  void add(const LaserScan& scan, const ScannerModel& scanner, const Pose2& odom_from_vehicle);

  const std::vector<Keyframe>& keyframes() const { return keyframes_; }
  const std::vector<TrackedScan>& scans() const { return scans_; }

 private:
  void drive_on(const Pose2& odom_from_vehicle);
  bool is_due() const;
  Pose2 lay(const LaserScan& scan, const ScannerModel& scanner);
  void keep(const ScanMove& move);
  void learn_excess(const Keyframe& frame);

  OdometryNoise noise_;
  TrackingStepOptions options_;
  ScanMotion motion_;
  std::vector<Keyframe> keyframes_;
  std::vector<TrackedScan> scans_;
  double raw_excess_ = 1.0;            // squared errors of dead reckoning against those stated
  double odometry_excess_ = 1.0;       // the same, no less than one
  int skipped_ = 0;                    // scans since the last that was laid
  Pose2 last_scan_pose_;               // of the last scan
  PoseWithCovariance since_found_;     // dead reckoning
  PoseWithCovariance since_keyframe_;  // dead reckoning
  Pose2 previous_odometry_;            // of the last scan
};

}  // namespace adit
