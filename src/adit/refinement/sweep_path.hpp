#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "adit/motion/pose_history.hpp"
#include "adit/motion/twist.hpp"
#include "adit/scan/sweep_timing.hpp"

namespace adit {

/// Where the vehicle is during a sweep, seen from where it is at the stamp: samples evenly spaced
/// in time, and between them `interpolate`. Of no length for a scanner that takes all at once.
struct SweepPath {
  static constexpr std::size_t kSteps = 16;

  double begin_s = 0.0;  ///< from the stamp
  double span_s = 0.0;
  std::array<Pose2, kSteps + 1> stamp_from_vehicle{};

  double time(std::size_t sample) const {
    return begin_s + span_s * static_cast<double>(sample) / static_cast<double>(kSteps);
  }
  Pose2 at(double seconds) const {
    if (!(span_s > 0.0)) return Pose2{};
    const double place =
        std::clamp((seconds - begin_s) / span_s, 0.0, 1.0) * static_cast<double>(kSteps);
    const std::size_t k = std::min(static_cast<std::size_t>(place), kSteps - 1);
    return interpolate(stamp_from_vehicle[k], stamp_from_vehicle[k + 1],
                       place - static_cast<double>(k));
  }
};

/// A steady motion as a path over a sweep of so many beams.
inline SweepPath steady_path(const Twist2& twist, const SweepTiming& timing, std::size_t beams) {
  SweepPath path;
  path.begin_s = timing.first_s;
  path.span_s = timing.step_s * static_cast<double>(beams);
  for (std::size_t k = 0; k < path.stamp_from_vehicle.size(); ++k) {
    path.stamp_from_vehicle[k] = moved(twist, path.time(k));
  }
  return path;
}

/// What dead reckoning missed of a sweep's motion: two steady motions, seen from the vehicle at the
/// stamp, one for each half of the sweep (odometry's error need not be steady for as long as a
/// sweep).
struct SweepCorrection {
  static constexpr std::size_t kHalves = 2;

  std::array<Twist2, kHalves> halves{};
  double middle_s = 0.0;  ///< of the sweep, from the stamp

  /// How much of the time from the stamp to `seconds` lies in each half (s, signed).
  std::array<double, kHalves> shares(double seconds) const {
    const double low = std::min(seconds, 0.0);
    const double high = std::max(seconds, 0.0);
    const double sign = seconds < 0.0 ? -1.0 : 1.0;
    return {sign * std::max(0.0, std::min(high, middle_s) - low),
            sign * std::max(0.0, high - std::max(low, middle_s))};
  }
  Pose2 at(double seconds) const {
    const std::array<double, kHalves> share = shares(seconds);
    const Pose2 first = moved(halves[0], share[0]);
    const Pose2 second = moved(halves[1], share[1]);
    return middle_s < 0.0 ? second * first : first * second;  // from the stamp outwards
  }
};

}  // namespace adit
