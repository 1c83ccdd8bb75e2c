#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "adit/geometry/pose2.hpp"

namespace adit {

/// Where one pose of a graph lies, seen from another.
struct PoseConstraint {
  std::size_t from = 0;
  std::size_t to = 0;
  Pose2 from_to;
  Matrix3d information = Matrix3d::Zero();  ///< over (x, y, theta) in the frame of `from`
  double robust_sigmas = 0.0;  ///< beyond this it pulls ever less (Cauchy); 0: it is believed
};

/// What a solution came to.
struct GraphSummary {
  bool usable = false;  ///< else the poses stay as they were
  bool converged = false;
  int iterations = 0;
  double cost = 0.0;
};

/// Moves the poses, all but the first, to where the constraints are fulfilled best (Lu and Milios
/// 1997), by Ceres on one thread: the same poses whatever the machine.
GraphSummary solve_pose_graph(std::vector<Pose2>& poses,
                              std::span<const PoseConstraint> constraints, int max_iterations);

/// The weighted squared error of a constraint at the poses.
double squared_error(const PoseConstraint& constraint, const Pose2& from, const Pose2& to);

/// How much of its information a constraint brings to bear at the poses, from 0 to 1: less than all
/// where it is robust and off.
double robust_share(const PoseConstraint& constraint, const Pose2& from, const Pose2& to);

}  // namespace adit
