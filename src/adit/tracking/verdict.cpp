#include "adit/tracking/verdict.hpp"

#include <algorithm>
#include <cmath>

namespace adit {

bool explains(const FitQuality& quality, const StatusOptions& options) {
  const double asked =
      std::min(options.least_evidence_ratio + options.evidence_per_behind * quality.behind_ratio,
               options.most_evidence_ratio);
  return quality.converged && quality.evidence_ratio > asked &&
         quality.wall_ratio > options.least_wall_ratio &&
         quality.behind_ratio < options.most_behind_ratio;
}

bool Trust::next(const FitQuality& quality, double way_m, const StatusOptions& options) {
  if (quality.returns < options.fewest_returns) return false;
  if (disagrees(quality, options) || !explains(quality, options) || is_sudden(quality, options)) {
    contradicted_ = true;
    regained_m_ = 0.0;
    return false;
  }
  if (!contradicted_) {
    note_usual(quality);
    return true;
  }
  const double asked = scans_ > 0.0 ? usual_ - options.regain_slack : options.regain_evidence_ratio;
  const bool regains = quality.evidence_ratio > asked;
  regained_m_ = regains ? regained_m_ + way_m : 0.0;
  contradicted_ = regained_m_ < options.regain_way_m;
  return !contradicted_;
}

void Trust::note_usual(const FitQuality& quality) {
  constexpr double kMostScans = 100.0;
  constexpr double kRecentScans = 8.0;
  scans_ = std::min(scans_ + 1.0, kMostScans);
  usual_ += (quality.evidence_ratio - usual_) / scans_;
  const double recent_scans = std::min(scans_, kRecentScans);
  recent_ += (quality.evidence_ratio - recent_) / recent_scans;
  recent_behind_ += (quality.behind_ratio - recent_behind_) / recent_scans;
}

/// The evidence ratio of scans around here.
double Trust::usual(const StatusOptions& options) const {
  return scans_ >= options.usual_scans ? usual_ : options.first_evidence_ratio;
}

/// Whether the fit lies where dead reckoning does not expect it and does not make up for that by
/// how much of the scan it explains.
bool Trust::disagrees(const FitQuality& quality, const StatusOptions& options) const {
  if (quality.agrees) return false;
  const bool has_dropped =
      !contradicted_ && usual(options) - quality.evidence_ratio > options.disagreeing_drop;
  return has_dropped || quality.evidence_ratio <= options.regain_evidence_ratio;
}

/// Whether the vehicle seems to have been carried off: a scan is explained less than the last few
/// were, and rock is seen through; or so much less that nothing can have come into its way.
bool Trust::is_sudden(const FitQuality& quality, const StatusOptions& options) const {
  if (contradicted_) return false;
  const bool is_known = scans_ >= options.usual_scans;
  const double evidence = is_known ? recent_ : options.first_evidence_ratio;
  const double behind = is_known ? recent_behind_ : options.first_behind_ratio;
  if (is_known && evidence - quality.evidence_ratio > options.sudden_drop_ratio) return true;
  return evidence - quality.evidence_ratio > options.sudden_evidence_ratio &&
         quality.behind_ratio - behind > options.sudden_behind_ratio;
}

std::optional<Vector2d> open_direction(const Matrix3d& fix_covariance,
                                       const StatusOptions& options) {
  const double xx = fix_covariance(0, 0);
  const double yy = fix_covariance(1, 1);
  const double xy = fix_covariance(0, 1);
  const double largest = 0.5 * (xx + yy) + std::hypot(0.5 * (xx - yy), xy);
  if (largest > options.degraded_sigma_m * options.degraded_sigma_m) {
    return unit_vector(0.5 * std::atan2(2.0 * xy, xx - yy));
  }
  const double heading = options.degraded_sigma_rad;
  if (fix_covariance(2, 2) > heading * heading) return Vector2d(Vector2d::Zero());
  return std::nullopt;
}

}  // namespace adit
