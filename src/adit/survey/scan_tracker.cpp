#include "adit/survey/scan_tracker.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "adit/geometry/uncertain_move.hpp"

namespace adit {
namespace {

constexpr double kWellHeld = 0.05;       // weaker over stronger direction, nearly
constexpr double kLeastVariance = 1e-6;  // of dead reckoning between keyframes, m² and rad²

}  // namespace

ScanTracker::ScanTracker(const OdometryNoise& noise, const TrackingStepOptions& options,
                         const SurfaceOptions& surface, const AlignmentOptions& alignment)
    : noise_(noise), options_(options), motion_(options.motion, surface, alignment) {}

/// A running mean of how much larger the squared errors of dead reckoning are than stated.
void ScanTracker::learn_excess(const Keyframe& frame) {
  constexpr double kMemory = 0.05;  // of one keyframe
  constexpr double kMost = 25.0;
  const Matrix2d held = frame.tracked_information.topLeftCorner<2, 2>();
  const double trace = held.trace();
  if (!(held.determinant() > kWellHeld * trace * trace)) return;  // nothing to compare with
  const Vector3d error = difference(frame.odometry, frame.previous_from_this);
  const Matrix3d covariance =
      frame.odometry_covariance / odometry_excess_ + kLeastVariance * Matrix3d::Identity();
  const double squared = error.dot(covariance.inverse() * error) / 3.0;
  raw_excess_ += kMemory * (std::min(squared, kMost) - raw_excess_);
  odometry_excess_ = std::max(1.0, raw_excess_);
}

/// Makes a keyframe of the scan that was kept last.
void ScanTracker::keep(const ScanMove& move) {
  const KeptScan& kept = motion_.kept().back();
  Keyframe frame;
  frame.scan = scans_.size();
  frame.shape = kept.shape;
  frame.beam_sigma_m = kept.beam_sigma_m;
  frame.pose = kept.frame_from_vehicle;
  if (!keyframes_.empty()) {
    const Pose2& before = keyframes_.back().pose;
    frame.previous_from_this = inverse(before) * frame.pose;
    frame.tracked_information = turned(move.information, -before.theta);
    frame.odometry = since_keyframe_.pose;
    frame.odometry_covariance = since_keyframe_.covariance * odometry_excess_;
    frame.odometry_covariance.diagonal().array() += kLeastVariance;
    learn_excess(frame);
  }
  keyframes_.push_back(std::move(frame));
  since_keyframe_ = {};
}

void ScanTracker::drive_on(const Pose2& odom_from_vehicle) {
  const Pose2 move = inverse(previous_odometry_) * odom_from_vehicle;
  previous_odometry_ = odom_from_vehicle;
  // A machine that reports no move adds nothing: the floors are for moves.
  if (move.translation().norm() > 1e-6 || std::abs(move.theta) > 1e-6) {
    since_found_ = dead_reckon(since_found_, move, noise_);
    since_keyframe_ = dead_reckon(since_keyframe_, move, noise_);
  }
}

bool ScanTracker::is_due() const {
  return since_found_.pose.translation().norm() >= options_.step_m ||
         std::abs(since_found_.pose.theta) >= options_.step_rad ||
         skipped_ >= options_.most_skipped;
}

/// Where the scan was taken, as far as scans and dead reckoning tell.
Pose2 ScanTracker::lay(const LaserScan& scan, const ScannerModel& scanner) {
  PoseWithCovariance predicted = motion_.predict(since_found_);
  predicted.covariance *= odometry_excess_;
  const ScanMove move = motion_.lay(scan, scanner, predicted);
  if (move.is_found) since_found_ = {};
  if (move.is_kept) keep(move);
  return move.frame_from_vehicle;
}

void ScanTracker::add(const LaserScan& scan, const ScannerModel& scanner,
                      const Pose2& odom_from_vehicle) {
  if (keyframes_.empty()) {
    keep(motion_.lay(scan, scanner, {}));
    previous_odometry_ = odom_from_vehicle;
    scans_.push_back({});
    return;
  }
  drive_on(odom_from_vehicle);
  Pose2 pose = motion_.last() * since_found_.pose;
  if (is_due()) {
    skipped_ = 0;
    pose = lay(scan, scanner);
  } else {
    ++skipped_;
  }
  const TrackedScan& before = scans_.back();
  const Pose2 moved = inverse(last_scan_pose_) * pose;
  const double way = before.way_m + moved.translation().norm() + std::abs(moved.theta);
  last_scan_pose_ = pose;
  scans_.push_back({keyframes_.size() - 1, inverse(keyframes_.back().pose) * pose, way});
}

}  // namespace adit
