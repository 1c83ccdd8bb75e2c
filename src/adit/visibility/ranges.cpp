#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "adit/geometry/angle.hpp"
#include "adit/visibility/visibility.hpp"

namespace adit {
namespace {

// Fraction of a step by which an interval takes beams beyond its ends, so that rounding leaves no
// beam between two neighbours.
constexpr double kSlack = 1e-9;

/// Unit vectors of evenly spaced bearings, one sine and cosine for each block of beams.
class BeamFan {
 public:
  BeamFan(double first, double step) : first_(first), step_(step) {
    for (std::size_t i = 0; i < kBlock; ++i) {
      offsets_[i] = unit_vector(static_cast<double>(i) * step);
    }
  }

  Vector2d direction(std::size_t beam) {
    const std::size_t block = beam / kBlock;
    if (block != block_) {
      block_ = block;
      base_ = unit_vector(first_ + static_cast<double>(block * kBlock) * step_);
    }
    const Vector2d& offset = offsets_[beam % kBlock];
    return {base_.x() * offset.x() - base_.y() * offset.y(),
            base_.x() * offset.y() + base_.y() * offset.x()};
  }

 private:
  static constexpr std::size_t kBlock = 32;
  double first_;
  double step_;
  std::array<Vector2d, kBlock> offsets_;
  std::size_t block_ = std::numeric_limits<std::size_t>::max();
  Vector2d base_ = Vector2d::UnitX();
};

}  // namespace

/// Deals the beams out to the intervals that they meet: `take(interval, from, stop)`. A beam at the
/// very end of two is dealt to both.
template <class Take>
void Visibility::deal_out(double first_bearing, double bearing_step, std::size_t beams,
                          Take&& take) const {
  const double last_beam = static_cast<double>(beams - 1);
  const double last_bearing = first_bearing + last_beam * bearing_step;
  const auto [lowest, highest] = std::minmax(first_bearing, last_bearing);
  const double slack = kSlack * std::abs(bearing_step);
  for (std::size_t k = 0; k < turns_.size(); ++k) {
    const auto [begin, end] = turns_[k];
    const double last_turn = std::floor((highest + slack - begin) / kTwoPi);
    for (double turn = std::ceil((lowest - slack - end) / kTwoPi); turn <= last_turn; turn += 1.0) {
      const double at_begin = (begin + turn * kTwoPi - first_bearing) / bearing_step;
      const double at_end = (end + turn * kTwoPi - first_bearing) / bearing_step;
      const auto [from, to] = std::minmax(at_begin, at_end);
      const double from_beam = std::max(0.0, std::ceil(from - kSlack));
      const double end_beam = std::min(last_beam, std::floor(to + kSlack)) + 1.0;
      if (!(from_beam < end_beam)) continue;
      take(k, static_cast<std::size_t>(from_beam), static_cast<std::size_t>(end_beam));
    }
  }
}

void Visibility::ranges(double first_bearing, double bearing_step, std::span<double> out,
                        std::span<int> walls) const {
  std::fill(out.begin(), out.end(), std::numeric_limits<double>::infinity());
  std::fill(walls.begin(), walls.end(), -1);
  if (out.empty() || !std::isfinite(first_bearing) || !std::isfinite(bearing_step)) return;
  if (bearing_step == 0.0) {  // all beams are the first
    ranges(first_bearing, 1.0, out.first(1), walls.first(std::min<std::size_t>(walls.size(), 1)));
    std::fill(out.begin(), out.end(), out.front());
    if (!walls.empty()) std::fill(walls.begin(), walls.end(), walls.front());
    return;
  }
  BeamFan fan(first_bearing, bearing_step);
  deal_out(first_bearing, bearing_step, out.size(),
           [&](std::size_t k, std::size_t from, std::size_t stop) {
             for (std::size_t i = from; i < stop; ++i) {
               const double range = 1.0 / cross(fan.direction(i), inverse_ranges_[k]);
               if (!(range < out[i])) continue;
               out[i] = range;
               if (!walls.empty()) walls[i] = intervals_[k].wall;
             }
           });
}

void Visibility::walls_along(double first_bearing, double bearing_step,
                             std::span<int> walls) const {
  std::fill(walls.begin(), walls.end(), -1);
  if (walls.empty() || !std::isfinite(first_bearing) || !std::isfinite(bearing_step)) return;
  if (bearing_step == 0.0) {  // all beams are the first
    walls_along(first_bearing, 1.0, walls.first(1));
    std::fill(walls.begin(), walls.end(), walls.front());
    return;
  }
  deal_out(first_bearing, bearing_step, walls.size(),
           [&](std::size_t k, std::size_t from, std::size_t stop) {
             for (std::size_t i = from; i < stop; ++i) walls[i] = intervals_[k].wall;
           });
}

}  // namespace adit
