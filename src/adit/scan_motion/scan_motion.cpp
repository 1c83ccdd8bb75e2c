#include "adit/scan_motion/scan_motion.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <utility>

#include "adit/geometry/uncertain_move.hpp"

namespace adit {
namespace {

constexpr FieldOptions kLocalField{0.1, 0.1, 0.0, 25.0};

}  // namespace

ScanMotion::ScanMotion(const ScanMotionOptions& options, const SurfaceOptions& surface,
                       const AlignmentOptions& alignment)
    : options_(options), surface_options_(surface), alignment_options_(alignment) {}

PoseWithCovariance ScanMotion::predict(const PoseWithCovariance& last_from_vehicle) const {
  return {last_ * last_from_vehicle.pose, turned(last_from_vehicle.covariance, last_.theta)};
}

ScanMove ScanMotion::lay(const LaserScan& scan, const ScannerModel& scanner,
                         const PoseWithCovariance& predicted) {
  const double beam_sigma_m = scanner.beam_sigma_m();
  ScanShape shape = maker_.shape(scan, scanner, surface_options_);
  ScanMove move;
  move.frame_from_vehicle = predicted.pose;
  if (kept_.empty()) {
    last_ = predicted.pose;
    move.is_kept = true;
    keep(std::move(shape), beam_sigma_m, predicted.pose);
    return move;
  }
  Matrix3d covariance = predicted.covariance;
  covariance.diagonal() +=
      Vector3d(options_.slip_m, options_.slip_m, options_.slip_rad).cwiseAbs2();
  const Fit fit = find({shape, beam_sigma_m, predicted.pose, covariance});
  move.is_found = fit.is_found;
  move.matched = fit.alignment.matched;
  move.matched_share = fit.alignment.matched_share;
  move.closeness = fit.alignment.closeness;
  if (fit.is_found) {
    move.frame_from_vehicle = fit.alignment.target_from_source;
    move.information = fit.alignment.information;
    move.move_information = turned(move.information, -last_.theta);
  }
  move.last_from_vehicle = inverse(last_) * move.frame_from_vehicle;
  if (fit.is_found) last_ = move.frame_from_vehicle;
  move.is_kept = is_to_be_kept(move.frame_from_vehicle);
  if (move.is_kept) keep(std::move(shape), beam_sigma_m, move.frame_from_vehicle);
  return move;
}

bool ScanMotion::is_to_be_kept(const Pose2& frame_from_vehicle) const {
  const Pose2 since = inverse(kept_.back().frame_from_vehicle) * frame_from_vehicle;
  return since.translation().norm() >= options_.keyframe_m ||
         std::abs(since.theta) >= options_.keyframe_rad;
}

void ScanMotion::keep(ScanShape shape, double beam_sigma_m, const Pose2& frame_from_vehicle) {
  const auto most = static_cast<std::size_t>(std::max(1, options_.local_keyframes));
  if (kept_.size() >= most) kept_.erase(kept_.begin());
  kept_.push_back({std::move(shape), beam_sigma_m, frame_from_vehicle});
  local_.clear();
  std::vector<PlacedShape> shapes;
  for (const KeptScan& kept : kept_) {
    local_.add(kept.shape.points, RigidTransform(kept.frame_from_vehicle));
    shapes.push_back({&kept.shape, kept.frame_from_vehicle});
  }
  local_.index();
  field_.build(shapes, false, kLocalField);
}

SearchWindow ScanMotion::window_around(const Guess& guess) const {
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

Alignment ScanMotion::align_from(const Guess& guess, const Pose2& start, const Pose2& prior) const {
  const double doubt2 = options_.odometry_doubt * options_.odometry_doubt;
  return align(guess.shape.points, local_, {prior, (doubt2 * guess.covariance).inverse()}, start,
               guess.beam_sigma_m, alignment_options_);
}

/// Another place for a scan that does not fit where it is predicted.
std::optional<Alignment> ScanMotion::look_farther(const Guess& guess, SearchWindow window) {
  window.reach_m = std::min(options_.most_search_m, 3.0 * window.reach_m);
  window.reach_rad = std::min(options_.most_search_rad, 3.0 * window.reach_rad);
  window.most_cost = options_.most_odometry_score;
  window.sigma_m *= 2.0;
  window.sigma_rad *= 2.0;
  const auto far = search_.best(field_, window, options_.good_score - window.most_cost);
  if (!far || far->score < options_.good_score) return std::nullopt;
  return align_from(guess, far->pose, far->pose);
}

/// Whether the prediction does not expect it; or expects so many places that one fits by chance.
bool ScanMotion::is_surprising(const Guess& guess, const Alignment& fit) const {
  const Vector3d off = difference(guess.predicted, fit.target_from_source);
  return std::sqrt(off.dot(guess.covariance.inverse() * off)) > options_.surprising_sigmas ||
         off.head<2>().norm() > options_.search_m || std::abs(off.z()) > options_.search_rad;
}

/// How well the points go with the walls at a pose, 0 to 1.
double ScanMotion::closeness(const Guess& guess, const Pose2& pose) const {
  const double reach = std::max(alignment_options_.last_reach_m, 3.0 * guess.beam_sigma_m);
  const double scale = std::max({alignment_options_.scale_m, 2.0 * guess.beam_sigma_m,
                                 0.3 * alignment_options_.last_reach_m});
  return linearize(guess.shape.points, local_, pose, reach, scale).mean_closeness();
}

/// Whether the scan alone says enough against the prediction. A pose elsewhere in the window is
/// fitted by chance the sooner, the fewer points there are, and along a gallery any is.
bool ScanMotion::is_sure(const Guess& guess, const Alignment& fit,
                         double close_at_prediction) const {
  return fit.matched >= options_.surprising_matched &&
         fit.matched_share >= options_.surprising_share &&
         closeness(guess, fit.target_from_source) >= close_at_prediction + options_.better_share;
}

ScanMotion::Fit ScanMotion::find(const Guess& guess) {
  const PlacedShape query{&guess.shape, Pose2{}};
  search_.set_points({&query, 1}, field_);
  const SearchWindow window = window_around(guess);
  const auto near = search_.best(field_, window, 0.0);
  const Alignment beside = align_from(guess, near ? near->pose : guess.predicted, guess.predicted);
  const bool is_beside = !is_surprising(guess, beside);
  const double close_at_prediction =
      closeness(guess, is_beside ? beside.target_from_source : guess.predicted);
  const auto is_believed = [&](const Alignment& fit) {
    return !is_surprising(guess, fit) || is_sure(guess, fit, close_at_prediction);
  };
  Fit fit{beside, is_believed(beside)};
  if (!near || near->score < options_.good_score) {
    // A scan of what was not seen before fits badly, too; elsewhere it would have to fit well.
    const auto other = look_farther(guess, window);
    const bool is_better =
        other && other->matched_share > beside.matched_share + options_.better_share;
    if (is_better && is_believed(*other)) fit = {*other, true};
  }
  fit.is_found = fit.is_found && fit.alignment.matched >= options_.least_matched &&
                 fit.alignment.matched_share >= options_.least_share;
  return fit;
}

}  // namespace adit
