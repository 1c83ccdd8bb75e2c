#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "adit/motion/odometry.hpp"
#include "adit/survey/alignment.hpp"
#include "adit/survey/correlative_search.hpp"
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
  struct Placed {
    Pose2 pose;
    Matrix3d information = Matrix3d::Zero();  // of the scan alone, tracking frame
    bool found = false;                       // else by dead reckoning alone
  };
  /// What is known of a scan before it is placed.
  struct Guess {
    const ScanShape& shape;
    double beam_sigma_m;
    Pose2 predicted;
    Matrix3d covariance;
  };

  Placed place(const Guess& guess);
  std::optional<Alignment> look_farther(const Guess& guess, SearchWindow window);
  Alignment lay(const Guess& guess, const Pose2& start, const Pose2& prior) const;
  double closeness(const Guess& guess, const Pose2& pose) const;
  bool is_surprising(const Guess& guess, const Alignment& fit) const;
  bool is_sure(const Guess& guess, const Alignment& fit, double close_at_odometry) const;
  SearchWindow window_around(const Guess& guess) const;
  void keep(ScanShape shape, double beam_sigma_m, const Placed& placed);
  void rebuild_local_map();
  void learn_excess(const Keyframe& frame);

  OdometryNoise noise_;
  TrackingStepOptions options_;
  SurfaceOptions surface_options_;
  AlignmentOptions alignment_options_;
  SurfaceMaker maker_;
  SurfaceMap local_;
  EvidenceField field_;
  CorrelativeSearch search_;
  std::vector<Keyframe> keyframes_;
  std::vector<TrackedScan> scans_;
  double raw_excess_ = 1.0;            // squared errors of dead reckoning against those stated
  double odometry_excess_ = 1.0;       // the same, no less than one
  int skipped_ = 0;                    // scans since the last that was placed
  Pose2 last_pose_;                    // of the last scan that was placed
  Pose2 last_scan_pose_;               // of the last scan
  PoseWithCovariance since_placed_;    // dead reckoning
  PoseWithCovariance since_keyframe_;  // dead reckoning
  Pose2 previous_odometry_;            // of the last scan
};

}  // namespace adit
