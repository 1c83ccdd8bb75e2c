#pragma once

namespace adit {

/// Probability that a chi-square variable of `dof` >= 1 degrees of freedom exceeds `x`; exact sums
/// for whole degrees of freedom (Abramowitz and Stegun 26.4.4, 26.4.5), cost O(dof).
double chi_square_tail(double x, int dof);

/// The value that a chi-square variable stays below with probability `p` in [0, 1].
double chi_square_quantile(double p, int dof);

}  // namespace adit
