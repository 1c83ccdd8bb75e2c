#include "adit/io/log.hpp"

namespace adit {

std::string to_string(const LaserId& laser) {
  switch (laser.kind) {
    case LaserKind::flaser:
      return "FLASER";
    case LaserKind::rlaser:
      return "RLASER";
    case LaserKind::robotlaser:
      break;
  }
  return "ROBOTLASER" + std::to_string(laser.number);
}

const char* to_string(RangeSource source) {
  switch (source) {
    case RangeSource::configuration:
      return "configuration";
    case RangeSource::parameter:
      return "parameter";
    case RangeSource::field:
      return "field";
    case RangeSource::found:
      return "found";
    case RangeSource::assumed:
      break;
  }
  return "assumed";
}

long LogSummary::scans() const {
  long total = 0;
  for (const LaserSummary& laser : lasers) total += laser.scans;
  return total;
}

void Log::add(LogMessage&& message) {
  if (auto* scan = std::get_if<LogScan>(&message)) {
    scan->odometry_before = odometry.size();
    scans.push_back(std::move(*scan));
  } else if (const auto* pose = std::get_if<LogOdometry>(&message)) {
    odometry.push_back(pose->odom_from_vehicle);
  } else if (const auto* truth = std::get_if<LogTruePose>(&message)) {
    true_poses.push_back(truth->map_from_vehicle);
  }
}

}  // namespace adit
