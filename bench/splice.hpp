#pragma once

#include <cstddef>

#include "adit/simulation/vehicle.hpp"

namespace adit {

/// The second recording after the first, its odometry after the first's last move made once more.
inline Recording spliced(Recording first, const Recording& second) {
  const std::size_t n = first.scans.size();
  const Pose2 last_move = inverse(first.odometry[n - 2]) * first.odometry[n - 1];
  const double begin = 2.0 * first.truth[n - 1].stamp - first.truth[n - 2].stamp;
  for (std::size_t i = 0; i < second.scans.size(); ++i) {
    const Pose2 move = i == 0 ? last_move : inverse(second.odometry[i - 1]) * second.odometry[i];
    const double stamp = begin + second.truth[i].stamp - second.truth[0].stamp;
    first.odometry.push_back(first.odometry.back() * move);
    first.truth.push_back({stamp, second.truth[i].pose});
    first.scans.push_back(second.scans[i]);
    first.scans.back().stamp = stamp;
  }
  return first;
}

}  // namespace adit
