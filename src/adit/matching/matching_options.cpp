#include "adit/matching/matching_options.hpp"

#include <algorithm>
#include <cmath>

namespace adit {
namespace {

double largest_eigenvalue(double xx, double xy, double yy) {
  const double mean = 0.5 * (xx + yy);
  const double half_difference = 0.5 * (xx - yy);
  return mean + std::sqrt(half_difference * half_difference + xy * xy);
}

// Anything that is not a finite variance means that nothing is known.
double within(double variance, double sigmas, double floor, double cap) {
  if (!(std::isfinite(variance) && variance >= 0.0)) return cap;
  return std::min(std::max(sigmas * std::sqrt(variance), floor), cap);
}

}  // namespace

MatchingOptions tolerances_from_prior(const MatchingOptions& base,
                                      const Matrix3d& covariance_of_predicted_scanner_pose) {
  MatchingOptions options = base;
  if (base.consistency == Consistency::paper) return options;
  const Matrix3d& c = covariance_of_predicted_scanner_pose;
  options.poserr = within(largest_eigenvalue(c(0, 0), 0.5 * (c(0, 1) + c(1, 0)), c(1, 1)),
                          base.prior_sigmas, base.min_poserr, base.max_poserr);
  options.angerr = within(c(2, 2), base.prior_sigmas, base.min_angerr, base.max_angerr);
  return options;
}

}  // namespace adit
