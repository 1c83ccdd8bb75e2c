#pragma once

#include <string>

#include "adit/localizer/settings.hpp"
#include "cell.hpp"

namespace adit {

/// Sixteen digits that change with any setting of the estimator, and with the cell's line.
std::string fingerprint_of(const Cell& cell, const LocalizerSettings& settings);

}  // namespace adit
