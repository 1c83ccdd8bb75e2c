#include "adit/evaluation/chi_square.hpp"

#include <cmath>
#include <limits>

#include "adit/geometry/angle.hpp"

namespace adit {

double chi_square_tail(double x, int dof) {
  if (!(x > 0.0)) return 1.0;
  if (std::isinf(x)) return 0.0;
  const double half = 0.5 * x;
  const bool odd = dof % 2 != 0;
  // Tail and next term of the recursion Q(x | k + 2) = Q(x | k) + half^(k/2) e^-half / (k/2)!.
  double tail = odd ? std::erfc(std::sqrt(half)) : std::exp(-half);
  double term = odd ? 2.0 * std::sqrt(half / kPi) * std::exp(-half) : half * std::exp(-half);
  for (int k = odd ? 1 : 2; k + 2 <= dof; k += 2) {
    tail += term;
    term *= half / (0.5 * k + 1.0);
  }
  return std::fmin(tail, 1.0);
}

double chi_square_quantile(double p, int dof) {
  if (!(p > 0.0)) return 0.0;
  if (p >= 1.0) return std::numeric_limits<double>::infinity();
  double high = dof;
  while (chi_square_tail(high, dof) > 1.0 - p) high *= 2.0;
  double low = 0.0;
  // Bisection to the last bit of a double.
  for (int i = 0; i < 200; ++i) {
    const double middle = 0.5 * (low + high);
    if (middle <= low || middle >= high) break;
    (chi_square_tail(middle, dof) > 1.0 - p ? low : high) = middle;
  }
  return high;
}

}  // namespace adit
