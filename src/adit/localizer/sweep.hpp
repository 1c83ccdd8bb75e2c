#pragma once

#include <optional>

#include "adit/deskew/deskewer.hpp"
#include "adit/localizer/settings.hpp"
#include "adit/motion/pose_history.hpp"
#include "adit/refinement/refinement.hpp"
#include "adit/scan/laser_scan.hpp"
#include "adit/scan/scanner_model.hpp"

namespace adit {

/// A scan, and the same as it would have been taken at its stamp at once. Views its maker's
/// buffers, and the scan.
struct Sweep {
  const LaserScan& scan;
  const LaserScan& still;
  const ScannerModel& scanner;
  std::optional<SweepPrior> motion;  ///< of a scanner that takes its time
};

/// Undoes the motion during a sweep, by odometry.
class SweepUndoer {
 public:
  /// The settings must outlive it.
  explicit SweepUndoer(const LocalizerSettings& settings) : settings_(settings) {}

  /// Views `scan`, and holds until the next call.
  Sweep undo(const LaserScan& scan, const PoseHistory& odometry);

 private:
  const LocalizerSettings& settings_;
  Deskewer deskewer_;
  LaserScan deskewed_;
};

}  // namespace adit
