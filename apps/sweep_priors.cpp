#include "sweep_priors.hpp"

#include <algorithm>

#include "adit/deskew/sweep_motion.hpp"
#include "adit/motion/pose_history.hpp"

namespace adit {

SweepPriors::SweepPriors(const Log& log, const LocalizerSettings& settings)
    : settings_(settings), odometry_(log.odometry) {
  for (const LogScan& scan : log.scans) {
    odometry_.push_back({scan.scan.stamp, scan.odom_from_vehicle});
  }
  std::stable_sort(odometry_.begin(), odometry_.end(),
                   [](const StampedPose& a, const StampedPose& b) { return a.stamp < b.stamp; });
}

std::optional<SweepPrior> SweepPriors::of(const LaserScan& scan) const {
  const ScannerModel& scanner = settings_.scanner_of(scan);
  if (!(scanner.sweep_s > 0.0)) return std::nullopt;
  const double reach = 2.0 * scanner.sweep_s + settings_.localizer.max_age_s;
  auto next =
      std::lower_bound(odometry_.begin(), odometry_.end(), scan.stamp - reach,
                       [](const StampedPose& pose, double stamp) { return pose.stamp < stamp; });
  PoseHistory history;
  for (; next != odometry_.end() && next->stamp <= scan.stamp + reach; ++next) history.add(*next);
  const SweepMotion motion =
      sweep_motion(history, scan.stamp, scanner, settings_.odometry, settings_.motion);
  const std::size_t beams = scan.ranges.size();
  return SweepPrior{steady_path(motion.twist, sweep_timing(scanner, beams), beams),
                    motion.covariance};
}

}  // namespace adit
