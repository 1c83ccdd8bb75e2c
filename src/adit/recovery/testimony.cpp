#include "adit/recovery/testimony.hpp"

#include <cmath>

#include "adit/relocation/fit_quality.hpp"

namespace adit {

Testimony testimony_of(const ScanFit& fit, const StatusOptions& status,
                       double sure_evidence_ratio) {
  const FitQuality quality = quality_of(fit);
  if (quality.returns < status.fewest_returns) return Testimony::blind;
  if (!explains(quality, status)) return Testimony::contradicts;
  if (!(quality.evidence_ratio > sure_evidence_ratio)) return Testimony::weak;
  return open_direction(fix_covariance(fit.information), status) ? Testimony::open
                                                                 : Testimony::sure;
}

Witness witness_of(const ScanFit& fit) {
  constexpr double kImpossible = -1e9;
  const double likelihood = fit.log_likelihood;
  const double share = shared_ratio(fit);
  return {std::isfinite(likelihood) ? likelihood : kImpossible, std::isfinite(share) ? share : 0.0,
          true};
}

PoseWithCovariance loosened(const PoseWithCovariance& pose) {
  constexpr double kFloor = 0.1;  // m
  constexpr double kFloorRad = 0.02;
  PoseWithCovariance out = pose;
  out.covariance.diagonal() += Vector3d(kFloor, kFloor, kFloorRad).cwiseAbs2();
  return out;
}

PoseObservation observation_of(const ScanFit& fit) {
  return {fit.pose, fit.score, fit.information, fit.white_information};
}

}  // namespace adit
