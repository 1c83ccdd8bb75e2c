#include "parts.hpp"

namespace adit {

void mount_scanner(const Cell& cell, Scene& scene) {
  constexpr double kTurned = radians(10.0);
  if (cell.fault == ScannerFault::turned) scene.scanner.vehicle_from_laser.theta = kTurned;
  if (cell.fault == ScannerFault::lever_arm) scene.scanner.vehicle_from_laser.x = 1.0;
  if (cell.fault == ScannerFault::dust) scene.scanner.dust_ratio = 0.1;
  if (cell.fault == ScannerFault::dropouts) scene.scanner.dropout_ratio = 0.2;
}

void spoil_scans(const Cell& cell, std::uint64_t seed, Scene& scene) {
  static_cast<void>(seed);
  for (LaserScan& scan : scene.recording.scans) {
    const bool is_hidden =
        cell.fault == ScannerFault::turned || cell.fault == ScannerFault::lever_arm;
    if (is_hidden) scan.vehicle_from_laser = Pose2{};
  }
}

}  // namespace adit
