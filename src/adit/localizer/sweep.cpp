#include "adit/localizer/sweep.hpp"

namespace adit {
namespace {

/// The vehicle's way during the sweep as the odometry has it, or a steady motion where it has none.
SweepPath path_of(const SweepMotion& motion, const LaserScan& scan, const ScannerModel& scanner,
                  const PoseHistory& odometry) {
  const std::size_t beams = scan.ranges.size();
  SweepPath path = steady_path(motion.twist, sweep_timing(scanner, beams), beams);
  const double spacing = path.span_s / static_cast<double>(SweepPath::kSteps);
  const std::optional<Pose2> at_stamp = odometry.at(scan.stamp, 0.0);
  if (!motion.known || !at_stamp ||
      !odometry.covers(scan.stamp + path.begin_s, path.span_s, 0.25 * path.span_s)) {
    return path;
  }
  for (std::size_t k = 0; k < path.stamp_from_vehicle.size(); ++k) {
    const std::optional<Pose2> there = odometry.at(scan.stamp + path.time(k), spacing);
    if (there) path.stamp_from_vehicle[k] = inverse(*at_stamp) * *there;
  }
  return path;
}

}  // namespace

Sweep SweepUndoer::undo(const LaserScan& scan, const PoseHistory& odometry) {
  const ScannerModel& scanner = settings_.scanner_of(scan);
  if (!(scanner.sweep_s > 0.0)) return {scan, scan, scanner, std::nullopt};
  const SweepMotion motion =
      sweep_motion(odometry, scan.stamp, scanner, settings_.odometry, settings_.motion);
  deskewer_.deskew(scan, scanner, motion.twist, settings_.deskew, deskewed_);
  return {scan, deskewed_, scanner,
          SweepPrior{path_of(motion, scan, scanner, odometry), motion.covariance}};
}

}  // namespace adit
