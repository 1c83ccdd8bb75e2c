#include "adit/simulation/odometry_faults.hpp"

#include <algorithm>

namespace adit {
namespace {

// Streams of the seed.
constexpr std::uint64_t kBursts = 16;
constexpr std::uint64_t kDropouts = 17;
constexpr std::uint64_t kJumps = 18;

}  // namespace

SlipBursts::SlipBursts(const OdometryFaults& faults, std::uint64_t seed)
    : faults_(faults), random_(seed, kBursts), left_m_(next_length(faults.calm_m)) {}

double SlipBursts::slip_over(double metres) {
  if (faults_.burst_ratio == 0.0) return 0.0;
  const double slip = is_slipping_ ? faults_.burst_ratio : 0.0;
  left_m_ -= metres;
  if (left_m_ <= 0.0) {
    is_slipping_ = !is_slipping_;
    left_m_ = next_length(is_slipping_ ? faults_.burst_m : faults_.calm_m);
  }
  return slip;
}

OdometryArrival::OdometryArrival(const OdometryFaults& faults, double begin, double end,
                                 std::uint64_t seed)
    : freeze_s_(faults.freeze_s), dropout_s_(faults.dropout_s), is_absent_(faults.is_absent) {
  Random dropouts(seed, kDropouts);
  for (int i = 0; i < faults.dropouts; ++i) {
    dropouts_.push_back(dropouts.uniform(begin, std::max(begin, end - faults.dropout_s)));
  }
  Random jumps(seed, kJumps);
  for (int i = 0; i < faults.jumps; ++i) {
    const double stamp = jumps.uniform(begin, end);
    const Vector2d by = faults.jump_m * unit_vector(jumps.uniform(-kPi, kPi));
    jumps_.push_back(
        {stamp, {by.x(), by.y(), jumps.chance(0.5) ? faults.jump_rad : -faults.jump_rad}});
  }
  std::stable_sort(jumps_.begin(), jumps_.end(),
                   [](const StampedPose& a, const StampedPose& b) { return a.stamp < b.stamp; });
}

bool OdometryArrival::is_lost(double stamp) const {
  return is_absent_ || std::any_of(dropouts_.begin(), dropouts_.end(), [&](double begin) {
           return stamp >= begin && stamp < begin + dropout_s_;
         });
}

}  // namespace adit
