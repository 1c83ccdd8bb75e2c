#pragma once

#include <span>
#include <vector>

#include "adit/simulation/odometry_faults.hpp"

namespace adit {

/// Dead reckoning along a path, from its first knot. The error of a move from knot to knot is drawn
/// once and spread over it, so that the declared noise, which is linear in the move, holds however
/// often the wheels are read.
class Wheels {
 public:
  /// `felt`, the path as the wheels feel it, must outlive this.
  Wheels(const TimedPath& felt, std::span<const double> knots, const OdometryNoise& noise,
         double slip_ratio, const OdometryFaults& faults, std::uint64_t seed);

  Pose2 read(double t) const;

 private:
  struct Move {
    double from, to;
    Pose2 start;
    Vector3d error = Vector3d::Zero();
    double slip = 0.0;
    bool is_reported = true;
  };

  Move next_move(double from, double to, const Pose2& start, Random& random, SlipBursts& bursts);
  Pose2 read(double t, const Move& move) const;

  const TimedPath& felt_;
  OdometryNoise noise_;
  double slip_ratio_;
  OdometryFaults faults_;
  std::vector<Move> moves_;  // the last has no end
};

}  // namespace adit
