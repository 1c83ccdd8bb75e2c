#pragma once

#include <cstddef>

#include "adit/scan/scanner_model.hpp"

namespace adit {

/// When the beams of a scan are taken, relative to its stamp (s).
struct SweepTiming {
  double first_s = 0.0;  ///< the first beam; not above zero
  double step_s = 0.0;   ///< from one beam to the next

  double at(std::size_t beam) const { return first_s + static_cast<double>(beam) * step_s; }
};

/// The times of so many beams. Beam i is taken i/n of the sweep after the first, so that the last
/// is one step short of the sweep's end.
inline SweepTiming sweep_timing(const ScannerModel& scanner, std::size_t beams) {
  const double step_s = beams > 0 ? scanner.sweep_s / static_cast<double>(beams) : 0.0;
  switch (scanner.stamp) {
    case SweepMoment::start:
      return {0.0, step_s};
    case SweepMoment::middle:
      return {-0.5 * scanner.sweep_s, step_s};
    case SweepMoment::end:
      return {-scanner.sweep_s, step_s};
  }
  return {0.0, step_s};
}

}  // namespace adit
