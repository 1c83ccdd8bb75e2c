#include "adit/survey/scan_tracker.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace adit {
namespace {

/// The covariance of a move, turned into the frame in which its start has this heading.
Matrix3d turned(const Matrix3d& matrix, double theta) {
  Matrix3d rotation = Matrix3d::Identity();
  const Vector2d axis = unit_vector(theta);
  rotation.topLeftCorner<2, 2>() << axis.x(), -axis.y(), axis.y(), axis.x();
  return rotation * matrix * rotation.transpose();
}

constexpr double kWellHeld = 0.05;       // weaker over stronger direction, nearly
constexpr double kLeastVariance = 1e-6;  // of dead reckoning between keyframes, m² and rad²
constexpr FieldOptions kTrackingField{0.1, 0.1, 0.0, 25.0};

}  // namespace

ScanTracker::ScanTracker(const OdometryNoise& noise, const TrackingStepOptions& options,
                         const SurfaceOptions& surface, const AlignmentOptions& alignment)
    : noise_(noise), options_(options), surface_options_(surface), alignment_options_(alignment) {}

void ScanTracker::rebuild_local_map() {
  const std::size_t count =
      std::min(keyframes_.size(), static_cast<std::size_t>(std::max(1, options_.local_keyframes)));
  local_.clear();
  std::vector<PlacedShape> shapes;
  for (std::size_t i = keyframes_.size() - count; i < keyframes_.size(); ++i) {
    local_.add(keyframes_[i].shape.points, RigidTransform(keyframes_[i].pose));
    shapes.push_back({&keyframes_[i].shape, keyframes_[i].pose});
  }
  local_.index();
  field_.build(shapes, false, kTrackingField);
}

SearchWindow ScanTracker::window_around(const Guess& guess) const {
  const Matrix3d& covariance = guess.covariance;
  SearchWindow window;
  window.middle = guess.predicted;
  window.sigma_m = std::sqrt(0.5 * (covariance(0, 0) + covariance(1, 1))) + 0.01;
  window.sigma_rad = std::sqrt(covariance(2, 2)) + 0.002;
  window.reach_m = std::min(options_.most_search_m,
                            std::max(options_.search_m, options_.search_sigmas * window.sigma_m));
  window.reach_rad =
      std::min(options_.most_search_rad,
               std::max(options_.search_rad, options_.search_sigmas * window.sigma_rad));
  return window;
}

Alignment ScanTracker::lay(const Guess& guess, const Pose2& start, const Pose2& prior) const {
  const double doubt2 = options_.odometry_doubt * options_.odometry_doubt;
  return align(guess.shape.points, local_, {prior, (doubt2 * guess.covariance).inverse()}, start,
               guess.beam_sigma_m, alignment_options_);
}

/// Another place for a scan that does not fit where dead reckoning has it.
std::optional<Alignment> ScanTracker::look_farther(const Guess& guess, SearchWindow window) {
  window.reach_m = std::min(options_.most_search_m, 3.0 * window.reach_m);
  window.reach_rad = std::min(options_.most_search_rad, 3.0 * window.reach_rad);
  window.most_cost = options_.most_odometry_score;
  window.sigma_m *= 2.0;
  window.sigma_rad *= 2.0;
  const auto far = search_.best(field_, window, options_.good_score - window.most_cost);
  if (!far || far->score < options_.good_score) return std::nullopt;
  return lay(guess, far->pose, far->pose);
}

/// Whether dead reckoning does not expect it; or expects so many places that one fits by chance.
bool ScanTracker::is_surprising(const Guess& guess, const Alignment& fit) const {
  const Vector3d off = difference(guess.predicted, fit.target_from_source);
  return std::sqrt(off.dot(guess.covariance.inverse() * off)) > options_.surprising_sigmas ||
         off.head<2>().norm() > options_.search_m || std::abs(off.z()) > options_.search_rad;
}

/// How well the points go with the walls at a pose, 0 to 1.
double ScanTracker::closeness(const Guess& guess, const Pose2& pose) const {
  const double reach = std::max(alignment_options_.last_reach_m, 3.0 * guess.beam_sigma_m);
  const double scale = std::max({alignment_options_.scale_m, 2.0 * guess.beam_sigma_m,
                                 0.3 * alignment_options_.last_reach_m});
  const Linearization at = linearize(guess.shape.points, local_, pose, reach, scale);
  return at.tried > 0 ? at.closeness / at.tried : 0.0;
}

/// Whether the scan alone says enough against dead reckoning. A pose elsewhere in the window is
/// fitted by chance the sooner, the fewer points there are, and along a gallery any is.
bool ScanTracker::is_sure(const Guess& guess, const Alignment& fit,
                          double close_at_odometry) const {
  return fit.matched >= options_.surprising_matched &&
         fit.matched_share >= options_.surprising_share &&
         closeness(guess, fit.target_from_source) >= close_at_odometry + options_.better_share;
}

ScanTracker::Placed ScanTracker::place(const Guess& guess) {
  const PlacedShape query{&guess.shape, Pose2{}};
  search_.set_points({&query, 1}, field_);
  const SearchWindow window = window_around(guess);
  const auto near = search_.best(field_, window, 0.0);
  const Alignment beside = lay(guess, near ? near->pose : guess.predicted, guess.predicted);
  const bool is_beside = !is_surprising(guess, beside);
  const double close_at_odometry =
      closeness(guess, is_beside ? beside.target_from_source : guess.predicted);
  const auto is_believed = [&](const Alignment& fit) {
    return !is_surprising(guess, fit) || is_sure(guess, fit, close_at_odometry);
  };
  std::optional<Alignment> fit;
  if (is_believed(beside)) fit = beside;
  if (!near || near->score < options_.good_score) {
    // A scan of what was not seen before fits badly, too; elsewhere it would have to fit well.
    const auto other = look_farther(guess, window);
    const bool is_better =
        other && other->matched_share > beside.matched_share + options_.better_share;
    if (is_better && is_believed(*other)) fit = other;
  }
  if (!fit || fit->matched < options_.least_matched || fit->matched_share < options_.least_share) {
    return {guess.predicted, Matrix3d::Zero(), false};
  }
  return {fit->target_from_source, fit->information, true};
}

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

void ScanTracker::keep(ScanShape shape, double beam_sigma_m, const Placed& placed) {
  Keyframe frame;
  frame.scan = scans_.size();
  frame.shape = std::move(shape);
  frame.beam_sigma_m = beam_sigma_m;
  frame.pose = placed.pose;
  if (!keyframes_.empty()) {
    const Pose2& before = keyframes_.back().pose;
    frame.previous_from_this = inverse(before) * placed.pose;
    frame.tracked_information = turned(placed.information, -before.theta);
    frame.odometry = since_keyframe_.pose;
    frame.odometry_covariance = since_keyframe_.covariance * odometry_excess_;
    frame.odometry_covariance.diagonal().array() += kLeastVariance;
    learn_excess(frame);
  }
  keyframes_.push_back(std::move(frame));
  since_keyframe_ = {};
  rebuild_local_map();
}

void ScanTracker::add(const LaserScan& scan, const ScannerModel& scanner,
                      const Pose2& odom_from_vehicle) {
  if (keyframes_.empty()) {
    keep(maker_.shape(scan, scanner, surface_options_), scanner.beam_sigma_m(), {});
    previous_odometry_ = odom_from_vehicle;
    scans_.push_back({});
    return;
  }
  const Pose2 move = inverse(previous_odometry_) * odom_from_vehicle;
  previous_odometry_ = odom_from_vehicle;
  // A machine that reports no move adds nothing: the floors are for moves.
  if (move.translation().norm() > 1e-6 || std::abs(move.theta) > 1e-6) {
    since_placed_ = dead_reckon(since_placed_, move, noise_);
    since_keyframe_ = dead_reckon(since_keyframe_, move, noise_);
  }
  Pose2 pose = last_pose_ * since_placed_.pose;
  if (since_placed_.pose.translation().norm() >= options_.step_m ||
      std::abs(since_placed_.pose.theta) >= options_.step_rad ||
      skipped_ >= options_.most_skipped) {
    skipped_ = 0;
    ScanShape shape = maker_.shape(scan, scanner, surface_options_);
    Matrix3d covariance = turned(since_placed_.covariance, last_pose_.theta);
    covariance *= odometry_excess_;
    covariance.diagonal() +=
        Vector3d(options_.slip_m, options_.slip_m, options_.slip_rad).cwiseAbs2();
    const Placed placed = place({shape, scanner.beam_sigma_m(), pose, covariance});
    pose = placed.pose;
    if (placed.found) {
      last_pose_ = pose;
      since_placed_ = {};
    }
    const Pose2 since = inverse(keyframes_.back().pose) * pose;
    if (since.translation().norm() >= options_.keyframe_m ||
        std::abs(since.theta) >= options_.keyframe_rad) {
      keep(std::move(shape), scanner.beam_sigma_m(), placed);
    }
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
