#pragma once

#include <span>

#include "adit/geometry/pose2.hpp"
#include "adit/scan/laser_scan.hpp"
#include "adit/scan/scanner_model.hpp"

namespace adit {

/// How far a scanner's plane is from level (rad): pitch about y (nose down is above zero), then
/// roll about x (left side up is above zero), as in REP-103.
struct ScanTilt {
  double pitch_rad = 0.0;
  double roll_rad = 0.0;
};

/// What is known of tilts and of what bounds the opening above and below.
struct TiltOptions {
  double tilt_sigma_rad = radians(2.0);
  double roof_above_m = 1.2;
  double floor_below_m = 1.0;
  double wall_error_m = 0.3;
  double roof_error_ratio = 0.1;

  template <class Self, class Field>
  static void visit(Self& self, Field&& field) {
    field("tilt_sigma_rad", self.tilt_sigma_rad,
          "pitch and roll of the scanner, one sigma (rad); 0 for a level scanner");
    field(
        "roof_above_m", self.roof_above_m,
        "roof above the scanner (m); what looks like roof is left out of walls, so that this need "
        "not be exact; 0 for no roof");
    field("floor_below_m", self.floor_below_m, "floor below the scanner (m); 0 for no floor");
    field("wall_error_m", self.wall_error_m,
          "how far beams may end from the walls found so far, one sigma (m)");
    field("roof_error_ratio", self.roof_error_ratio,
          "how uneven roof and floor are: their distance along a beam, one sigma, per metre");
  }
};

/// Range along a beam to roof or floor (m), infinite for a beam that stays between them.
double range_to_roof_or_floor(double bearing, const ScanTilt& tilt, const TiltOptions& options);

/// The tilt under which ranges are best explained, each by its wall or by roof or floor before it.
///
/// `walls[i]` is the level distance to the wall in beam i's way, infinite where none is known. The
/// cosine of so small tilts is far below the walls' errors: what tells the tilt is which beams end
/// in the open and where, against the prior; beams that meet neither count for nothing. Roof and
/// floor at the same distance cannot be told apart: then the tilt may come out reversed, with the
/// same beams at roof or floor.
ScanTilt estimate_tilt(const LaserScan& scan, std::span<const double> walls,
                       const TiltOptions& options);

/// The scan as a level scanner would have taken it: ranges foreshortened, bearings turned, and
/// beams that ended at roof or floor, or beyond where these must be, without return.
LaserScan level_scan(const LaserScan& scan, std::span<const double> walls, const ScanTilt& tilt,
                     const TiltOptions& options, const ScannerModel& scanner = {});

}  // namespace adit
