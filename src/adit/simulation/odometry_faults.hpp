#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "adit/motion/odometry.hpp"
#include "adit/simulation/random.hpp"
#include "adit/simulation/timed_path.hpp"

namespace adit {

/// How dead reckoning fails, beside its white errors.
///
/// Of a move by t (m, frame of its start) and a turn by w (rad) the wheels report
///   t' = (1 + slip) (1 + odometry_scale) t + e_t
///   w' = (1 + turn_scale) w + turn_bias |t| + e_w:
/// lasting errors first, then slip (`DriveOptions::slip_ratio`, in bursts `burst_ratio` more), then
/// the white error e. While the machine stands the wheels report `creep` ahead; a move slower than
/// `unreported_below` is not reported at all. Of the poses so reckoned some jump, some are lost,
/// and from some time on all are equal.
struct OdometryFaults {
  double odometry_scale = 0.0;
  double turn_scale = 0.0;
  double turn_bias = 0.0;
  double burst_ratio = 0.0;
  double burst_m = 4.0;
  double calm_m = 8.0;
  double creep = 0.0;
  double unreported_below = 0.0;
  int dropouts = 0;
  double dropout_s = 3.0;
  double freeze_s = -1.0;
  int jumps = 0;
  double jump_m = 1.0;
  double jump_rad = 0.0;
  bool is_absent = false;

  template <class Self, class Field>
  static void visit(Self& self, Field&& field) {
    field("odometry_scale", self.odometry_scale, "share by which moves are reported too long");
    field("turn_scale", self.turn_scale, "share by which turns are reported too large");
    field("turn_bias", self.turn_bias, "turn that is reported beside the true one (rad/m)");
    field("burst_ratio", self.burst_ratio, "share of slip in bursts");
    field("burst_m", self.burst_m, "length of a burst, within a half of it (m)");
    field("calm_m", self.calm_m, "way from burst to burst, within a half of it (m)");
    field("creep", self.creep, "motion ahead that is reported while the machine stands (m/s)");
    field("unreported_below", self.unreported_below,
          "motion slower than this, and turns below as many rad/s, are not reported (m/s)");
    field("dropouts", self.dropouts, "periods without odometry");
    field("dropout_s", self.dropout_s, "how long each of them lasts (s)");
    field("freeze_s", self.freeze_s,
          "from this time on every pose repeats the last (s); below zero: never");
    field("jumps", self.jumps, "jumps of the odometry's pose");
    field("jump_m", self.jump_m, "how far, in a random direction (m)");
    field("jump_rad", self.jump_rad, "and turned to one side or the other (rad)");
    field("is_absent", self.is_absent, "no odometry at all");
  }
};

/// Slip that comes and goes along the way.
class SlipBursts {
 public:
  SlipBursts(const OdometryFaults& faults, std::uint64_t seed);

  /// The slip of the next move, of so many metres: all of it slips or none.
  double slip_over(double metres);

 private:
  double next_length(double mean) { return mean * random_.uniform(0.5, 1.5); }

  OdometryFaults faults_;
  Random random_;
  bool is_slipping_ = false;
  double left_m_ = 0.0;
};

/// What arrives of dead reckoning: which poses are lost, where they jump and when they freeze.
class OdometryArrival {
 public:
  /// For a drive between two times (s).
  OdometryArrival(const OdometryFaults& faults, double begin, double end, std::uint64_t seed);

  /// Whether no pose arrives at this time.
  bool is_lost(double stamp) const;

  /// The pose that arrives, lost or not, where `reckoned(t)` is the one that was reckoned.
  template <class Reckoned>
  Pose2 pose(double stamp, Reckoned&& reckoned) const {
    const double t = freeze_s_ >= 0.0 ? std::min(stamp, freeze_s_) : stamp;
    if (jumps_.empty() || jumps_.front().stamp > t) return reckoned(t);
    Pose2 jumped_from_reckoned;
    for (const StampedPose& jump : jumps_) {
      if (jump.stamp > t) break;
      const Pose2 before = jumped_from_reckoned * reckoned(jump.stamp);
      jumped_from_reckoned = before * jump.pose * inverse(before) * jumped_from_reckoned;
    }
    return jumped_from_reckoned * reckoned(t);
  }

 private:
  double freeze_s_;
  double dropout_s_;
  bool is_absent_;
  std::vector<double> dropouts_;    // when they begin
  std::vector<StampedPose> jumps_;  // in the machine's frame
};

}  // namespace adit
