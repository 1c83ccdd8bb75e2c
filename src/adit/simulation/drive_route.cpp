#include "adit/simulation/drive_route.hpp"

#include <algorithm>
#include <functional>
#include <limits>
#include <queue>
#include <utility>

namespace adit {
namespace {

/// Cost of a metre with this room to walls: 5 at the clearance itself, and near 1 far off.
double cost_of_metre(double room, double clearance) {
  const double tightness = clearance / std::max(room, 1e-6);
  return 1.0 + 4.0 * tightness * tightness;
}

}  // namespace

DriveRoutes::DriveRoutes(const DriveMap& map, int from, double most_m,
                         const std::vector<bool>& is_barred)
    : nodes_(map.size(), {std::numeric_limits<double>::infinity(), 0.0, -1, false}) {
  using Entry = std::pair<double, int>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open;
  nodes_[static_cast<std::size_t>(from)].cost = 0.0;
  open.emplace(0.0, from);
  while (!open.empty()) {
    const auto place = static_cast<std::size_t>(open.top().second);
    open.pop();
    if (nodes_[place].is_reached) continue;
    nodes_[place].is_reached = true;
    reached_.push_back(static_cast<int>(place));
    if (nodes_[place].metres >= most_m) continue;
    for (const int link : map.links(place)) {
      const auto to = static_cast<std::size_t>(link);
      if (nodes_[to].is_reached || (!is_barred.empty() && is_barred[to])) continue;
      const double step = (map.place(to) - map.place(place)).norm();
      const double tightest = std::min(map.room(place), map.room(to));
      const double cost =
          nodes_[place].cost + step * cost_of_metre(tightest, map.options().clearance_m);
      if (cost >= nodes_[to].cost) continue;
      nodes_[to] = {cost, nodes_[place].metres + step, static_cast<int>(place), false};
      open.emplace(cost, link);
    }
  }
}

std::vector<int> DriveRoutes::way_to(int place) const {
  std::vector<int> way;
  if (!nodes_[static_cast<std::size_t>(place)].is_reached) return way;
  for (int at = place; at >= 0; at = nodes_[static_cast<std::size_t>(at)].previous) {
    way.push_back(at);
  }
  std::reverse(way.begin(), way.end());
  return way;
}

}  // namespace adit
