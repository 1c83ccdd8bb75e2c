#pragma once

#include <functional>
#include <span>
#include <vector>

#include "adit/geometry/result.hpp"
#include "adit/survey/drive_options.hpp"
#include "adit/survey/joint_registration.hpp"
#include "adit/survey/known_places.hpp"
#include "adit/survey/loop_search.hpp"

namespace adit {

/// Where the machine was when a scan was taken.
struct SurveyedPose {
  Pose2 map_from_vehicle;
  /// Of its keyframe against those around it, over (x, y, theta) in the map: what the whole drive
  /// or the map may be off is not in it.
  Matrix3d covariance = Matrix3d::Zero();
};

/// What a survey of a drive came to.
struct DriveResult {
  /// One for every scan, in order; the first is its odometry's unless places were known.
  std::vector<SurveyedPose> poses;
  std::vector<std::size_t> keyframes;  ///< which of the scans were kept
  std::vector<Closure> closures;       ///< between keyframes, as they were accepted
  std::size_t pairs = 0;  ///< constraints from laying keyframes onto each other at the end
};

/// Says which part of a stage is done, 0 to 1; may be empty.
using DriveProgress = std::function<void(const char* stage, double part)>;

/// Makes a globally consistent trajectory from scans and dead reckoning alone.
///
/// Scans are added one by one; only those of keyframes are kept. Results do not depend on the
/// number of threads.
class DriveSurvey {
 public:
  DriveSurvey(const OdometryNoise& noise, const DriveSurveyOptions& options);

  void add(const LaserScan& scan, const ScannerModel& scanner, const Pose2& odom_from_vehicle);
  /// Says where the vehicle was at a scan that has been added; the result is in that map's frame.
  /// Comes in the order of the scans; the first between a keyframe and the next counts.
  void know_place(std::size_t scan, const Pose2& map_from_vehicle, const Matrix3d& covariance);
  /// An Error where the poses cannot be solved for, or where memory or threads run out.
  Result<DriveResult> finish(int threads, const DriveProgress& progress = {});

 private:
  void solve_all(int threads, const DriveProgress& progress);
  std::vector<PoseConstraint> chain() const;
  std::vector<PoseConstraint> dead_reckoning() const;
  void solve_for(std::span<const PoseConstraint> constraints);
  void solve(double most_drift_m, int threads, const DriveProgress& progress);
  void close_loops(double most_drift_m, int threads, const DriveProgress& progress);
  bool close_loops_within(double limit_m, int threads);
  void register_jointly(int threads, const DriveProgress& progress);
  std::size_t torn() const;
  void solve_in_map();
  Pose2 pose_of(const TrackedScan& scan) const;
  std::vector<Matrix3d> covariances() const;
  DriveResult result() const;

  DriveSurveyOptions options_;
  Pose2 map_from_drive_;  // drive: the frame in which the first scan's pose is the identity
  ScanTracker tracker_;
  std::vector<Pose2> poses_;  // of the keyframes
  std::vector<Closure> closures_;
  std::vector<PoseConstraint> constraints_;  // of the last solution
  std::size_t pairs_ = 0;
  bool solved_ = true;
  std::vector<KnownPlace> known_;
};

}  // namespace adit
