#pragma once

#include <optional>
#include <vector>

#include "adit/io/log.hpp"
#include "adit/localizer/settings.hpp"
#include "adit/refinement/refinement.hpp"

namespace adit {

/// How the machine moved during the sweeps of a log's scans, by the log's odometry.
class SweepPriors {
 public:
  SweepPriors(const Log& log, const LocalizerSettings& settings);

  /// None for a scanner that takes its scan at once.
  std::optional<SweepPrior> of(const LaserScan& scan) const;

 private:
  const LocalizerSettings& settings_;
  std::vector<StampedPose> odometry_;  // in order of time
};

}  // namespace adit
