#include "adit/localizer/fitter.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <limits>

#include "adit/localizer/prior_floor.hpp"
#include "adit/relocation/fit_quality.hpp"

namespace adit {

void Fitter::reset() {
  map_error_ = MapErrorEstimator(settings_.map);
  first_map_error_.reset();
}

Fits Fitter::fit(const Sweep& sweep, const Expectation& expected, Timings& timings) {
  Fits fits;
  features_.clear();
  if (wants_features(expected)) match_features(sweep, expected, timings, fits);
  const bool uses_points = settings_.estimator != Estimator::features;
  if (uses_points && !expected.is_anywhere) fit_points(sweep, expected, timings, fits);
  return fits;
}

/// Features find the pose when the prediction is too unsure to fit all points from there.
bool Fitter::wants_features(const Expectation& expected) const {
  const LocalizerOptions& options = settings_.localizer;
  if (settings_.estimator != Estimator::full) return settings_.estimator == Estimator::features;
  if (expected.is_anywhere) return false;
  const Matrix3d& covariance = expected.vehicle.covariance;
  const double metres = options.features_sigma_m;
  const double radians = options.features_sigma_rad;
  return options.features_every_scan || expected.is_doubted ||
         covariance.topLeftCorner<2, 2>().trace() > metres * metres ||
         covariance(2, 2) > radians * radians;
}

void Fitter::match_features(const Sweep& sweep, const Expectation& expected, Timings& timings,
                            Fits& fits) {
  const bool is_alone = settings_.estimator == Estimator::features;
  const double sigma_m = is_alone ? settings_.map.sigma_m : map_error().sigma_m();
  fits.uses_features = true;
  fits.features = features_.fit(sweep, expected.vehicle, sigma_m, timings);
}

/// All points of the scan against the map, from where the features say or, without them, from the
/// prediction; and where that is poor from elsewhere near it.
void Fitter::fit_points(const Sweep& sweep, const Expectation& expected, Timings& timings,
                        Fits& fits) {
  const RefinementInput fit_input = input(sweep);
  PoseWithCovariance start = floored_at(expected.vehicle);
  {
    const Stopwatch watch(timings.refinement);
    if (expected.rival) {
      // It stays where its own dead reckoning leaves it: the walls that it holds for wrong must
      // not draw it to the estimate.
      const PoseWithCovariance at = floored_at(*expected.rival);
      fits.rival = refiner_.refine(fit_input, at, at, settings_.refinement);
    }
    if (fits.features.is_believable) start = fits.features.vehicle;
    fits.best = refine(fit_input, expected.vehicle, start);
  }
  if (is_poor(fits.best, expected)) search(sweep, expected, start, timings, fits);
}

ScanFit Fitter::fit_from(const Sweep& sweep, const PoseWithCovariance& predicted) {
  return refine(input(sweep), predicted, floored_at(predicted));
}

PoseWithCovariance Fitter::floored_at(const PoseWithCovariance& predicted) const {
  return {predicted.pose, floored(predicted.covariance, settings_.localizer)};
}

/// The prediction is a loose prior: slipping wheels may have spoilt it beyond its covariance.
const ScanFit& Fitter::refine(const RefinementInput& input, const PoseWithCovariance& predicted,
                              const PoseWithCovariance& start) {
  const PoseWithCovariance loose{
      predicted.pose,
      settings_.localizer.prior_inflation * floored(predicted.covariance, settings_.localizer)};
  return refiner_.refine(input, loose, start, settings_.refinement);
}

bool Fitter::is_poor(const ScanFit& fit, const Expectation& expected) const {
  const SearchOptions& options = settings_.search;
  const FitQuality quality = quality_of(fit);
  const Vector3d off = difference(expected.vehicle.pose, fit.pose);
  const double asked = std::min(
      options.poor_evidence_ratio + options.poor_evidence_per_behind * quality.behind_ratio,
      options.most_poor_evidence_ratio);
  return !quality.converged || quality.evidence_ratio < asked ||
         has_lost_direction(fit, expected) ||
         off.dot(floored(expected.vehicle.covariance, settings_.localizer).inverse() * off) >
             options.poor_chi_square;
}

/// Whether the scan leaves a direction open that the last one showed: what showed it may be in
/// sight still, but too far from where this fit expects it.
bool Fitter::has_lost_direction(const ScanFit& fit, const Expectation& expected) const {
  return expected.was_all_shown &&
         open_direction(fix_covariance(fit.information), settings_.status).has_value();
}

/// The most plausible fit near the prediction: the first one, those from the features and from the
/// prediction itself, and the one from the best of a lattice around it.
void Fitter::search(const Sweep& sweep, const Expectation& expected,
                    const PoseWithCovariance& first, Timings& timings, Fits& fits) {
  const RefinementInput fit_input = input(sweep);
  const PoseWithCovariance prediction = floored_at(expected.vehicle);
  std::array<PoseWithCovariance, 3> starts;
  std::size_t count = 0;
  starts[count++] = first;
  if (fits.features.is_believable) {
    starts[count++] = prediction;  // the first fit began at the features
  } else if (settings_.estimator == Estimator::full && !fits.uses_features) {
    match_features(sweep, expected, timings, fits);
    if (fits.features.is_believable) starts[count++] = fits.features.vehicle;
  }
  const Stopwatch watch(timings.search);
  starts[count++] = most_likely_near(fit_input, prediction);
  const double shared = shared_ratio(fits.best);
  std::array<ScanFit, 3> found;
  std::array<double, 3> scores{};
  std::size_t best = 0;
  for (std::size_t i = 0; i < count; ++i) {
    found[i] = i == 0 ? fits.best : refine(fit_input, expected.vehicle, starts[i]);
    scores[i] = found[i].converged ? plausibility(found[i], prediction, shared)
                                   : -std::numeric_limits<double>::infinity();
    if (scores[i] > scores[best]) best = i;
  }
  for (std::size_t i = 0; i < count && !fits.other; ++i) {
    if (i == best || !found[i].converged || !elsewhere(found[i], found[best])) continue;
    const double lead = scores[best] - scores[i];
    if (lead < settings_.status.rival_gain) fits.other = OtherFit{found[i], lead};
  }
  // The refiner's beams and shares are to be those of the fit that is taken: its last one.
  fits.best = best + 1 == count ? found[best] : refine(fit_input, expected.vehicle, starts[best]);
}

/// The best pose of a lattice, and how far it may lie from one that is better.
PoseWithCovariance Fitter::most_likely_near(const RefinementInput& input,
                                            const PoseWithCovariance& prediction) {
  const PoseLattice lattice(prediction, settings_.search);
  const Matrix3d spread = lattice.spread();
  return {refiner_.most_likely(input, prediction, lattice.poses(), spread, settings_.refinement),
          spread};
}

void Fitter::learn(const Sweep& sweep, const Matrix3d& covariance) {
  if (!settings_.map.is_stated && first_map_error_.is_open()) {
    first_map_error_.add(refiner_.beams(), sweep.scanner);
    MapErrorOptions options = settings_.map;
    options.sigma_m = first_map_error_.sigma_m();
    map_error_ = MapErrorEstimator(options);
  }
  map_error_.add(refiner_.beams(), refiner_.on_wall(), sweep.scanner, covariance);
}

FitDetails Fitter::details(const Sweep& sweep) const {
  return {features_.result(), features_.pairs_used(), refiner_.beams(), refiner_.on_wall(),
          refiner_.shares(),  map_error().sigma_m(),  sweep.scanner};
}

}  // namespace adit
