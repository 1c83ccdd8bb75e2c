#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "adit/survey/drive_options.hpp"
#include "adit/survey/pose_graph.hpp"

namespace adit {

/// Where a keyframe of a drive was in a map that was there before.
struct KnownPlace {
  std::size_t keyframe = 0;
  Pose2 map_from_vehicle;
  Matrix3d covariance = Matrix3d::Zero();  ///< over (x, y, theta) in the map
};

/// Moves the poses of a drive into the map's frame: first as a whole, then each to where the
/// constraints between them and the known places are fulfilled best. Where no place is known,
/// constraints alone carry the drive on.
GraphSummary solve_with_known_places(std::vector<Pose2>& poses,
                                     std::span<const PoseConstraint> constraints,
                                     std::span<const KnownPlace> known,
                                     const KnownPlacesOptions& options, int max_iterations);

/// The rigid motion that brings poses nearest to where they are known to be, in the mean of the
/// nearer half: map_from_drive.
Pose2 whole_motion(std::span<const Pose2> poses, std::span<const KnownPlace> known);

}  // namespace adit
