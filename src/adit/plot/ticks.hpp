#pragma once

#include <string>
#include <vector>

namespace adit {

/// The largest of 1, 2, 5 times a power of ten that is at most `value`; 1 for what is no positive
/// number.
double round_down(double value);

/// Round numbers in [lower, upper], at most about `most` of them.
std::vector<double> ticks(double lower, double upper, int most);

/// Powers of ten in [lower, upper], thinned to at most about `most`; both above zero.
std::vector<double> decade_ticks(double lower, double upper, int most);

/// A number with as many decimals as a scale in steps of `step` needs, with a true minus sign.
std::string tick_text(double value, double step);

}  // namespace adit
