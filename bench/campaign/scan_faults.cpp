#include "parts.hpp"

namespace adit {
namespace {

/// A scanner that looks back beside one that looks ahead; its scans stop changing half-way.
std::vector<ScannerSpec> one_of_two_fails(const ScannerSpec& ahead, double drive_s) {
  ScannerSpec back = ahead;
  back.vehicle_from_laser = {-1.0, 0.0, kPi};
  back.faults.repeat_after_s = drive_s / 2.0;
  return {ahead, back};
}

}  // namespace

std::vector<ScannerSpec> faulty_scanners(const Cell& cell, double drive_s) {
  ScannerSpec spec = scanner_named(cell.scanner).value_or(sick());
  ScannerFaults& faults = spec.faults;
  switch (cell.fault) {
    case ScannerFault::none:
    case ScannerFault::ramps:  // of the floor: things.cpp
      break;
    case ScannerFault::repeats:
      faults.repeat_after_s = drive_s / 3.0;
      break;
    case ScannerFault::mirrored:
      faults.is_mirrored = true;
      break;
    case ScannerFault::turned:
      faults.mount_yaw_rad = radians(10.0);
      break;
    case ScannerFault::lever_arm:
      faults.mount_x_m = 1.0;
      break;
    case ScannerFault::self_hits:
      faults.body_bearing_rad = radians(80.0);
      faults.body_width_rad = radians(30.0);
      break;
    case ScannerFault::one_of_two:
      return one_of_two_fails(spec, drive_s);
    case ScannerFault::dust:
      spec.dust_ratio = 0.1;
      break;
    case ScannerFault::dropouts:
      spec.dropout_ratio = 0.2;
      break;
  }
  return {spec};
}

}  // namespace adit
