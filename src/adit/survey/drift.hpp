#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <queue>
#include <span>
#include <utility>
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

 private:
  friend class DriftSearch;
  struct Edge {
    std::size_t to = 0;
    bool forward = true;  // whether the constraint runs this way
    Matrix3d covariance;  // over the relative pose, in the frame of its `from`
  };
  std::span<const Edge> edges_of(std::size_t node) const {
    return std::span(edges_).subspan(begins_[node], begins_[node + 1] - begins_[node]);
  }

  std::vector<std::size_t> begins_;  // of each node's edges, and their end
  std::vector<Edge> edges_;
};

/// Asks a bound of one node after another. A search costs what it reaches, not what the graph
/// holds; one for each thread, as it keeps its buffers.
class DriftSearch {
 public:
  /// A node, and how well it is known against the source.
  struct Reached {
    std::size_t node = 0;
    RelativeSigma sigma;
  };

  /// Both must outlive the search.
  DriftSearch(const DriftBound& bound, std::span<const Pose2> poses);

  void begin(std::size_t source);
  /// Of the nodes reached from those given so far the one known best, in position and heading
  /// together, up to where the sigma of the position passes the limit (m). Each is given once.
  std::optional<Reached> next(double limit_m);

 private:
  struct Label {
    std::uint32_t search = 0;  // in which it was set
    bool done = false;
    double size = 0.0;
    Matrix3d covariance;  // of position in the common frame, of heading, and between them
  };
  using Entry = std::pair<double, std::size_t>;

  void expand(std::size_t node);

  const DriftBound& bound_;
  std::span<const Pose2> poses_;
  std::uint32_t search_ = 0;
  std::vector<Label> labels_;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue_;
};

}  // namespace adit
