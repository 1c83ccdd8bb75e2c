#pragma once

#include <string>

#include "trial_options.hpp"

namespace adit {

/// What motion during a sweep costs: sweeps of 0.2 s at up to 5 m/s and 45 degrees a second,
/// stamped in the middle, with odometry of 2 % and 0.2 degrees a sweep at 50 Hz, against scans at
/// once from the same poses. Ratios of mean errors, over all scans and over those in bends.
std::string sweep_trial(const TrialOptions& options);

}  // namespace adit
