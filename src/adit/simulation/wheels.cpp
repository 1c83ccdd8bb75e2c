#include "adit/simulation/wheels.hpp"

#include <algorithm>
#include <cmath>

#include "adit/simulation/dead_reckoning.hpp"

namespace adit {
namespace {

constexpr std::uint64_t kWheels = 12;  // stream of the seed
constexpr double kStanding = 1e-9;     // m, rad

}  // namespace

Wheels::Wheels(const TimedPath& felt, std::span<const double> knots, const OdometryNoise& noise,
               double slip_ratio, const OdometryFaults& faults, std::uint64_t seed)
    : felt_(felt), noise_(noise), slip_ratio_(slip_ratio), faults_(faults) {
  Random random(seed, kWheels);
  SlipBursts bursts(faults, seed);
  moves_.push_back({knots.front(), knots.front(), Pose2{}});
  for (std::size_t i = 1; i < knots.size(); ++i) {
    moves_.back() = next_move(knots[i - 1], knots[i], moves_.back().start, random, bursts);
    moves_.push_back({knots[i], knots[i], read(knots[i], moves_.back())});
  }
}

Wheels::Move Wheels::next_move(double from, double to, const Pose2& start, Random& random,
                               SlipBursts& bursts) {
  const Pose2 move = inverse(felt_.at(from)) * felt_.at(to);
  const double metres = move.translation().norm();
  const double turn = std::abs(move.theta);
  Move out{from, to, start, draw_move_error(move, noise_, random)};
  out.slip = slip_ratio_ + bursts.slip_over(metres);
  const double unreported = faults_.unreported_below * (to - from);
  out.is_reported = metres >= unreported || turn >= unreported;
  if (!out.is_reported) out.error.setZero();
  if (metres < kStanding && turn < kStanding) out.error.x() += faults_.creep * (to - from);
  return out;
}

Pose2 Wheels::read(double t) const {
  const auto after = std::upper_bound(moves_.begin(), moves_.end(), t,
                                      [](double time, const Move& m) { return time < m.from; });
  return read(t, after == moves_.begin() ? *after : *(after - 1));
}

Pose2 Wheels::read(double t, const Move& move) const {
  const double length = move.to - move.from;
  const double done = length > 0.0 ? std::clamp((t - move.from) / length, 0.0, 1.0) : 0.0;
  const Pose2 driven = move.is_reported ? inverse(felt_.at(move.from)) * felt_.at(t) : Pose2{};
  return move.start * reported_move(driven, move.slip, done * move.error, faults_);
}

}  // namespace adit
