#pragma once

#include <string>
#include <vector>

#include "adit/geometry/result.hpp"
#include "adit/simulation/odometry_faults.hpp"
#include "adit/simulation/scanner_faults.hpp"

namespace adit {

/// Sets the faults that are named, each as `key=number`; 1 or 0 for those that are or are not.
/// Errors: no such key, given twice, no number that suits it.
Result<void> set_faults(const std::vector<std::string>& pairs, OdometryFaults& odometry,
                        ScannerFaults& scanner);

/// What `--fault` takes: every key with its meaning, unit and default, a line each.
std::string fault_help();

}  // namespace adit
