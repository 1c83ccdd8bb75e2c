#pragma once

#include "adit/scan/laser_scan.hpp"
#include "adit/scan/scanner_model.hpp"

namespace adit {

/// Which ranges of a scan are returns: those above zero that are no less than the scanner's least
/// and below the range from which there are none (m).
struct ReturnLimits {
  double least_m = 0.0;
  double none_from_m = 0.0;

  /// False for not-a-number.
  bool is_return(double range) const {
    return range > 0.0 && range >= least_m && range < none_from_m;
  }
};

/// Those of a scan and the scanner that took it.
inline ReturnLimits return_limits(const LaserScan& scan, const ScannerModel& scanner) {
  return {scanner.min_range_m, scanner.no_return_from(scan.max_range)};
}

}  // namespace adit
