#pragma once

#include <vector>

#include "adit/simulation/drive_map.hpp"

namespace adit {

/// The ways that cost least from one place of a map to others. A metre costs more the nearer walls
/// are, so that ways keep to the middle of openings.
class DriveRoutes {
 public:
  /// From a place, so far (m) and no farther; `is_barred`, if not empty, tells for each place
  /// whether no way leads over it.
  DriveRoutes(const DriveMap& map, int from, double most_m,
              const std::vector<bool>& is_barred = {});

  /// Places with a way to them, the cheapest first; the first is where all begin.
  const std::vector<int>& reached() const { return reached_; }
  /// Length of the way to a place that is reached (m).
  double metres(int place) const { return nodes_[static_cast<std::size_t>(place)].metres; }
  /// Places of the way to one that is reached, from the first to it; empty for one that is not.
  std::vector<int> way_to(int place) const;

 private:
  struct Node {
    double cost;
    double metres;
    int previous;
    bool is_reached;
  };
  std::vector<Node> nodes_;
  std::vector<int> reached_;
};

}  // namespace adit
