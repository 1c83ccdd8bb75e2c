#include "adit/simulation/carried_off.hpp"

#include <algorithm>
#include <limits>

namespace adit {
namespace {

/// Time from the last scan of the first recording to the first of the next: as long as between the
/// last two.
double next_stamp(const Recording& first, const Recording& second) {
  const Recording& paced = first.truth.size() > 1 ? first : second;
  const std::size_t n = paced.truth.size();
  const double last = first.truth.back().stamp;
  if (n < 2) return last;
  return &paced == &first ? 2.0 * last - first.truth[n - 2].stamp
                          : last + paced.truth[1].stamp - paced.truth[0].stamp;
}

void append_wheels(const Recording& second, const Pose2& onto_first, double later,
                   Recording& first) {
  const double end =
      first.wheels.empty() ? -std::numeric_limits<double>::infinity() : first.wheels.back().stamp;
  for (const StampedPose& message : second.wheels) {
    if (message.stamp + later <= end) continue;
    first.wheels.push_back({message.stamp + later, onto_first * message.pose});
  }
}

void append_gyro(const Recording& second, double turn, Recording& first) {
  if (first.gyro.empty() || second.gyro.empty()) return;
  const double offset = first.gyro.back() + turn - second.gyro.front();
  for (const double heading : second.gyro) first.gyro.push_back(wrap_angle(heading + offset));
}

}  // namespace

Pose2 last_move(const Recording& recording) {
  const std::size_t n = recording.odometry.size();
  return n < 2 ? Pose2{} : inverse(recording.odometry[n - 2]) * recording.odometry[n - 1];
}

Recording carried_off(Recording first, const Recording& second, const Pose2& shown) {
  if (first.scans.empty()) return second;
  if (second.scans.empty()) return first;
  const std::size_t n = first.scans.size();
  const double begin = next_stamp(first, second);
  first.is_without_odometry.resize(n, false);
  for (std::size_t i = 0; i < second.scans.size(); ++i) {
    const Pose2 move = i == 0 ? shown : inverse(second.odometry[i - 1]) * second.odometry[i];
    const double stamp = begin + second.truth[i].stamp - second.truth[0].stamp;
    first.odometry.push_back(first.odometry.back() * move);
    first.is_without_odometry.push_back(!second.odometry_at(i));
    first.truth.push_back({stamp, second.truth[i].pose});
    first.scans.push_back(second.scans[i]);
    first.scans.back().stamp = stamp;
  }
  append_wheels(second, first.odometry[n] * inverse(second.odometry.front()),
                begin - second.truth.front().stamp, first);
  append_gyro(second, shown.theta, first);
  return first;
}

}  // namespace adit
