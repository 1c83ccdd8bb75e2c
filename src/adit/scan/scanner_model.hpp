#pragma once

#include <algorithm>
#include <cmath>

namespace adit {

/// Which moment of its sweep a scan's stamp names.
enum class SweepMoment { start, middle, end };

/// How a scanner measures; one sigma, SI units.
struct ScannerModel {
  double range_sigma_m = 0.02;
  double quantisation_m = 0.01;
  double bearing_sigma_rad = 0.0;
  double max_range_m = 80.0;
  double min_range_m = 0.05;
  double sweep_s = 0.0;
  SweepMoment stamp = SweepMoment::start;

  /// The range from which a scan has no returns: its own maximum, where it states one (above zero),
  /// but no more than the scanner's (m).
  double no_return_from(double max_range_of_scan) const {
    return max_range_of_scan > 0.0 ? std::min(max_range_of_scan, max_range_m) : max_range_m;
  }

  /// Standard deviation of one range along the beam: noise and rounding together (m).
  double beam_sigma_m() const {
    return std::sqrt(range_sigma_m * range_sigma_m + quantisation_m * quantisation_m / 12.0);
  }

  template <class Self, class Field>
  static void visit(Self& self, Field&& field) {
    field("range_sigma_m", self.range_sigma_m, "noise of a range, one sigma (m)");
    field("quantisation_m", self.quantisation_m, "step in which ranges are reported (m)");
    field("bearing_sigma_rad", self.bearing_sigma_rad, "noise of a beam's bearing (rad)");
    field("max_range_m", self.max_range_m, "a range at or over this is no return (m)");
    field("min_range_m", self.min_range_m, "a range below this is no return (m)");
    field("sweep_s", self.sweep_s,
          "time of one sweep (s); beam i is taken i/n of it after the first; 0 is all at once");
    field("stamp", self.stamp, "the moment of the sweep that a scan's stamp names");
  }
};

}  // namespace adit
