#pragma once

#include <vector>

#include "adit/information/bound.hpp"
#include "adit/map/line_map.hpp"
#include "adit/tracking/estimate.hpp"
#include "trial_scene.hpp"

namespace adit {

/// One seed's run, made ready: what the localizer is given, and what to judge it by.
struct TrialRun {
  TrialScene scene;
  LineMap map;
  Recording recording;
  PoseWithCovariance start;
  bool feeds_wheels = false;  ///< dead reckoning comes at its own rate, not with the scans
};

/// One answer of the localizer beside the truth.
struct Answer {
  std::uint64_t seed = 0;  ///< of the run
  std::size_t scan = 0;    ///< in the run
  Pose2 truth;
  Pose2 pose;
  Matrix3d covariance = Matrix3d::Zero();
  Status status = Status::lost;
  double protection_m = 0.0;
  double seconds = 0.0;  ///< of the cycle
  bool near_intersection = false;

  double position_error() const { return (pose.translation() - truth.translation()).norm(); }
  double heading_error() const { return std::abs(angle_between(truth.theta, pose.theta)); }
  bool is_trusted() const { return status == Status::ok || status == Status::degraded; }
};

/// The scene's whole path, with nothing wrong but what scanner and clutter do.
TrialRun plain_run(TrialScene scene, std::uint64_t seed);

/// The scanner's beams.
BeamFan fan_of(const ScannerSpec& scanner);

/// Localises the run of the seed, scan after scan or each scan alone, and adds its answers.
void localise(const TrialRun& run, const TrialOptions& options, std::uint64_t seed,
              std::vector<Answer>& answers);

}  // namespace adit
