// The pose that is tracked, and its rival near by; elsewhere.cpp has what is far away.
#include "adit/localizer/belief.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>

#include "adit/localizer/prior_floor.hpp"
#include "adit/relocation/fit_quality.hpp"

namespace adit {

void Belief::start(const PoseWithCovariance& map_from_vehicle) {
  trust_.reset();
  is_clear_ = true;
  is_doubled_ = false;
  rival_.reset();
  search_.reset();
  hypotheses_.clear();
  is_anywhere_ = false;
  is_confirmed_ = false;
  trusted_m_ = std::numeric_limits<double>::infinity();  // by whoever states the start
  is_found_ = true;
  tracker_.start(map_from_vehicle);
  begin_turn();
}

void Belief::start_anywhere() {
  is_anywhere_ = true;
  is_found_ = false;
  trusted_m_ = 0.0;
}

void Belief::begin_turn() {
  is_trusted_ = has_contributed_ = is_ambiguous_ = false;
  predicted_ = tracker_.estimate();
}

void Belief::move(const Motion& motion) {
  carry(motion, settings_.tracking, tracker_);
  if (motion.is_reckoned) hypotheses_.predict(motion.move, motion.noise, settings_.tracking);
  if (!motion.knows_way) hypotheses_.blur(motion.unknown_m, motion.unknown_rad);
  search_.move(motion);
  if (rival_) {
    carry(motion, settings_.tracking, rival_->tracker);
    rival_->way_m += motion.way_m();
  }
  predicted_ = tracker_.estimate();
}

Expectation Belief::expectation(const Estimate& last) const {
  Expectation expected;
  expected.vehicle = predicted_;
  if (rival_) expected.rival = rival_->tracker.estimate();
  expected.is_anywhere = is_anywhere_;
  expected.is_doubted = !is_clear_ || is_doubled_ || trust_.contradicted();
  expected.was_all_shown = !last.dead_reckoned && !last.open_direction;
  return expected;
}

bool Belief::weigh_rival(const Fits& fits) {
  if (fits.other && !rival_) add_rival(*fits.other);
  return fits.rival && weigh_rival(*fits.rival, fits.best);
}

/// Another pose that explains the scan about as well, from now on carried along.
void Belief::add_rival(const OtherFit& other) {
  rival_ = Rival{tracker_, other.lead, 0.0};
  rival_->tracker.update(observation_of(other.fit), settings_.tracking);
  is_ambiguous_ = other.lead < settings_.status.ambiguous_gain &&
                  explains(quality_of(other.fit), settings_.status);
}

/// Lets the scan decide between the pose and its rival, who both came here by dead reckoning.
/// Before the vehicle has gone some way from where they parted, one wall may speak for both scans.
bool Belief::weigh_rival(const ScanFit& rival_fit, const ScanFit& best) {
  const StatusOptions& options = settings_.status;
  const bool stands = explains(quality_of(rival_fit), options) && elsewhere(rival_fit, best);
  const bool is_as_good = quality_of(rival_fit).evidence_ratio >
                          options.rival_evidence_ratio * quality_of(best).evidence_ratio;
  if (stands) {
    const double gain = shared_ratio(best) * (best.log_likelihood - rival_fit.log_likelihood);
    rival_->lead = std::clamp(rival_->lead + gain, -options.rival_gain, options.rival_gain);
  }
  if (!stands && is_reconciled(best)) {
    rival_.reset();
    return false;
  }
  if (rival_->lead < -options.ambiguous_gain) {
    change_places();
    return true;
  }
  if (stands) rival_->tracker.update(observation_of(rival_fit), settings_.tracking);
  if (rival_->way_m > options.rival_way_m && !(stands && is_as_good)) {
    rival_.reset();
    return false;
  }
  is_ambiguous_ = stands && std::abs(rival_->lead) < options.ambiguous_gain;
  return false;
}

/// Whether the rival has become so unsure that the estimate is within its reach: they are one.
bool Belief::is_reconciled(const ScanFit& best) const {
  const PoseWithCovariance& rival = rival_->tracker.estimate();
  const Vector3d apart = difference(rival.pose, best.pose);
  const Matrix3d spread = rival.covariance + fix_covariance(best.information);
  return apart.dot(spread.inverse() * apart) < settings_.status.reconciled_chi_square;
}

/// The scans speak for the rival: it becomes the estimate, and the estimate its rival; both as they
/// were before this scan.
void Belief::change_places() {
  std::swap(tracker_, rival_->tracker);
  rival_->lead = -rival_->lead;
  predicted_ = tracker_.estimate();
}

bool Belief::take_in(const Fits& fits, const Motion& motion) {
  if (is_anywhere_) return false;
  if (!uses_points()) return take_in_features(fits.features);
  FitQuality quality = quality_of(fits.best);
  const LocalizerOptions& options = settings_.localizer;
  quality.agrees =
      tracker_.chi_square(observation_of(fits.best)) < settings_.tracking.gate_chi_square;
  is_clear_ = quality.evidence_ratio > options.clear_evidence_ratio;
  is_doubled_ = fits.best.counts.between > options.doubled_ratio * fits.best.counts.wall;
  const double way_m = motion.way_m();
  is_trusted_ = trust_.next(quality, way_m, settings_.status) && hypotheses_.empty();
  if (is_trusted_) {
    trusted_m_ += way_m;
    search_.schedule().note_success();
    if (is_clear_) search_.doubts().note_success();
  }
  take_in_points(fits.best, quality);
  return is_trusted_ && has_contributed_;
}

/// The paper's way: the features alone say where the vehicle is.
bool Belief::take_in_features(const FeatureFix& fix) {
  is_trusted_ = has_contributed_ = fix.is_believable;
  if (fix.is_believable) tracker_.start(fix.vehicle);
  return false;  // no point was fitted
}

/// What is not trusted may still be the truth: all that explains its scan is taken in.
void Belief::take_in_points(const ScanFit& fit, const FitQuality& quality) {
  const bool helps = quality.converged && quality.agrees &&
                     quality.evidence_ratio > settings_.status.used_evidence_ratio;
  has_contributed_ = helps || explains(quality, settings_.status);
  if (!has_contributed_) return;
  const PoseTracker before = tracker_;
  const double chi_square = tracker_.update(observation_of(fit), settings_.tracking);
  if (chi_square > settings_.tracking.gate_chi_square && !rival_) {
    rival_ = Rival{before, 0.0, 0.0};
    // One scan against all before it: the next must decide.
    is_ambiguous_ = chi_square > settings_.status.jump_chi_square;
  }
}

Believed Belief::believed() const {
  Believed out;
  out.pose = tracker_.estimate();
  out.predicted = predicted_;
  out.covariance = is_anywhere_          ? unknown_covariance()
                   : hypotheses_.empty() ? out.pose.covariance
                                         : hypotheses_.covariance_about(out.pose.pose);
  if (rival_) out.rival = rival_->tracker.estimate();
  out.is_trusted = is_trusted_;
  out.has_contributed = has_contributed_;
  out.is_ambiguous = is_ambiguous_;
  out.is_anywhere = is_anywhere_;
  out.is_divided = is_divided();
  return out;
}

}  // namespace adit
