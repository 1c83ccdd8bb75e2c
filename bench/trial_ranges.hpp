#pragma once

#include <cmath>
#include <vector>

#include "adit/information/bound.hpp"
#include "adit/map/line_map.hpp"
#include "adit/visibility/visibility.hpp"

namespace adit {

/// A plan and the pose of a vehicle in it.
struct PlanAt {
  const LineMap& map;
  const Pose2& map_from_vehicle;
};

/// Tells how differently two plans look, or one plan from two poses.
class RangeComparison {
 public:
  RangeComparison(const BeamFan& fan, double max_range)
      : fan_(fan),
        max_range_(max_range),
        first_(static_cast<std::size_t>(fan.count)),
        second_(first_.size()) {}

  /// Share of the scanner's beams whose ranges in the plans differ by more than `tolerance` (m);
  /// where a plan shows nothing, the range is the scanner's maximum.
  double share_apart(const PlanAt& one, const PlanAt& other, double tolerance) {
    look(one, first_);
    look(other, second_);
    int apart = 0;
    for (std::size_t i = 0; i < first_.size(); ++i) {
      apart += std::abs(first_[i] - second_[i]) > tolerance ? 1 : 0;
    }
    return static_cast<double>(apart) / static_cast<double>(first_.size());
  }

 private:
  void look(const PlanAt& from, std::vector<double>& ranges) {
    const Pose2 laser = from.map_from_vehicle * fan_.vehicle_from_laser;
    visibility_.sweep(from.map, laser.translation(), max_range_);
    visibility_.ranges(wrap_angle(laser.theta + fan_.first_bearing), fan_.bearing_step, ranges);
    for (double& range : ranges) range = std::fmin(range, max_range_);
  }

  BeamFan fan_;
  double max_range_;
  Visibility visibility_;
  std::vector<double> first_;
  std::vector<double> second_;
};

/// Whether the scan from the one pose contradicts the other pose: the plan's ranges differ by more
/// than 0.5 m in more than 40 % of the beams, far beyond what noise, roughness and clutter do.
inline bool contradicts(RangeComparison& ranges, const LineMap& map, const Pose2& truth,
                        const Pose2& believed) {
  return ranges.share_apart({map, truth}, {map, believed}, 0.5) > 0.4;
}

}  // namespace adit
