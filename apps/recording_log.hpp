#pragma once

#include "adit/io/log.hpp"
#include "adit/simulation/vehicle.hpp"

namespace adit {

/// A simulated recording as the log that a machine would have written: scans with their odometry
/// poses, and the wheels' own stream. The truth stays out of it. A log gives every scan a pose: one
/// that has none repeats the last. Scanners after the first write ROBOTLASER2, 3, ….
inline Log to_log(const Recording& recording, const ScannerSpec& spec) {
  Log log;
  for (std::size_t i = 0; i < recording.scans.size(); ++i) {
    LogScan scan;
    scan.scan = recording.scans[i];
    scan.laser.number = 1 + scan.scan.scanner;
    scan.odom_from_vehicle = recording.odometry[i];
    scan.accuracy_m = spec.model.range_sigma_m;
    log.scans.push_back(std::move(scan));
  }
  log.odometry = recording.wheels;
  return log;
}

}  // namespace adit
