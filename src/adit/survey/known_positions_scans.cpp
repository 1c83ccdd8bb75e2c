#include <algorithm>
#include <cmath>

#include "adit/survey/known_positions.hpp"

namespace adit {
namespace {

constexpr double kSameStamp = 1e-3;  // s

/// Which pose each scan has by its stamp; -1 for none.
std::vector<int> poses_by_stamp(std::span<const LaserScan> scans,
                                std::span<const StampedPose> poses) {
  std::vector<int> found;
  for (const LaserScan& scan : scans) {
    const auto at =
        std::lower_bound(poses.begin(), poses.end(), scan.stamp - kSameStamp,
                         [](const StampedPose& pose, double stamp) { return pose.stamp < stamp; });
    const bool same = at != poses.end() && at->stamp <= scan.stamp + kSameStamp;
    found.push_back(same ? static_cast<int>(at - poses.begin()) : -1);
  }
  return found;
}

int nearest_pose(std::span<const StampedPose> poses, double stamp) {
  const auto at =
      std::min_element(poses.begin(), poses.end(), [&](const StampedPose& a, const StampedPose& b) {
        return std::abs(a.stamp - stamp) < std::abs(b.stamp - stamp);
      });
  return static_cast<int>(at - poses.begin());
}

/// Gives scans without a pose of their own that of their station.
void fill_stations(std::span<const LaserScan> scans, std::span<const StampedPose> poses,
                   std::vector<int>& found) {
  const bool before = found.front() >= 0;
  const bool after = !before && found.back() >= 0;
  const auto count = static_cast<int>(found.size());
  for (int k = 0; k < count; ++k) {
    const int i = after ? count - 1 - k : k;
    const int neighbour = after ? i + 1 : i - 1;
    int& pose = found[static_cast<std::size_t>(i)];
    if (pose >= 0) continue;
    pose = before || after ? found[static_cast<std::size_t>(neighbour)]
                           : nearest_pose(poses, scans[static_cast<std::size_t>(i)].stamp);
  }
}

}  // namespace

Result<std::vector<PositionedScan>> place_scans(std::span<const LaserScan> scans,
                                                std::span<const StampedPose> poses,
                                                GivenHeadings headings) {
  if (poses.empty()) return fail("no poses are given for the scans");
  if (scans.empty()) return fail("there are no scans to place at the poses");
  std::vector<StampedPose> sorted(poses.begin(), poses.end());
  std::stable_sort(sorted.begin(), sorted.end(),
                   [](const StampedPose& a, const StampedPose& b) { return a.stamp < b.stamp; });
  const bool all_alike = std::all_of(poses.begin(), poses.end(), [&](const StampedPose& p) {
    return p.pose.theta == poses.front().pose.theta;
  });
  const bool believed =
      headings == GivenHeadings::all || (headings == GivenHeadings::automatic && !all_alike);
  std::vector<int> found = poses_by_stamp(scans, sorted);
  const std::vector<int> own = found;
  fill_stations(scans, sorted, found);
  std::vector<PositionedScan> placed;
  for (std::size_t i = 0; i < scans.size(); ++i) {
    const Pose2& pose = sorted[static_cast<std::size_t>(found[i])].pose;
    placed.push_back({scans[i], pose.translation(), std::nullopt, own[i] >= 0});
    if (believed) placed.back().heading = pose.theta;
  }
  return placed;
}

}  // namespace adit
