#pragma once

#include <span>
#include <vector>

#include "adit/survey/wall_nodes.hpp"

namespace adit {

/// Nodes of one wall in order, the open side on the left.
struct WallChain {
  std::vector<int> nodes;
  bool closed = false;  ///< the last is followed by the first, as round a pillar
};

/// Links each node to the one that follows it on the same wall, round corners too, and across gaps
/// that are narrow and that no beam went through. Wider gaps stay: they are openings, or nobody saw
/// the wall there.
std::vector<WallChain> link_wall_nodes(std::span<const WallNode> nodes, BeamEvidence& evidence,
                                       const WallOptions& options);

}  // namespace adit
