#pragma once

#include "adit/refinement/refinement.hpp"
#include "adit/tracking/verdict.hpp"

namespace adit {

/// How well a fit explains its scan.
FitQuality quality_of(const ScanFit& fit);

/// How much less the beams of a scan say together than each for itself, because neighbours share
/// the error of their wall: the ratio of the standard deviations without it and with it, a
/// direction's mean.
double shared_ratio(const ScanFit& fit);

/// How plausible a fit is (log): what it explains of the scan, and how far it is from the
/// prediction. A prediction may be wrong beyond its covariance, so its part has the tails of
/// Student's t.
double plausibility(const ScanFit& fit, const PoseWithCovariance& prediction, double shared);

/// Whether two fits are two places, not one found twice.
bool elsewhere(const ScanFit& a, const ScanFit& b);

}  // namespace adit
