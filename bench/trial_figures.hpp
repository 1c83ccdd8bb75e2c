#pragma once

#include <span>
#include <string>
#include <vector>

#include "trial_run.hpp"

namespace adit {

/// The accuracy of the answers: position and heading, along and across the vehicle, near
/// intersections and elsewhere, lost runs.
std::string accuracy_text(std::span<const Answer> answers);

/// Statuses, and how often a trusted answer was wrong.
std::string status_text(std::span<const Answer> answers);

/// Protection levels of the trusted answers: all, and those near intersections.
std::string protection_text(std::span<const Answer> answers);

/// The `count` trusted answers that err most, and where to find them again.
std::string worst_text(std::span<const Answer> answers, int count);

/// Microseconds of the cycle.
std::string time_text(std::span<const Answer> answers);

/// Errors over the Cramér-Rao bound of the same poses in a perfect plan without clutter.
std::string bound_text(std::span<const Answer> answers, const LineMap& map,
                       const ScannerSpec& scanner);

}  // namespace adit
