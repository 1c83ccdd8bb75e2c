#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "adit/survey/pose_graph.hpp"

namespace adit {

/// How well the pose of one node is known against another's, one sigma.
struct RelativeSigma {
  bool known = false;  ///< false: beyond the limit
  double metres = 0.0;
  double radians = 0.0;
};

/// The uncertainty of poses of a graph against one of them: along the chain of constraints on which
/// it grows least (Olson 2009: a bound from above that takes no inversion).
class DriftBound {
 public:
  /// Constraints that say nothing of a direction leave it as open as `open_m`.
  DriftBound(std::size_t nodes, std::span<const PoseConstraint> constraints, double open_m = 5.0);

  /// Against `source`, up to where the sigma passes the limit (m).
  std::vector<RelativeSigma> from(std::size_t source, std::span<const Pose2> poses,
                                  double limit_m) const;

 private:
  struct Edge {
    std::size_t to = 0;
    bool forward = true;  // whether the constraint runs this way
    Matrix3d covariance;  // over the relative pose, in the frame of its `from`
  };
  std::vector<std::vector<Edge>> edges_;
};

}  // namespace adit
