#include "adit/simulation/machine_ahead.hpp"

#include <algorithm>

namespace adit {
namespace {

constexpr double kStep = 0.1;     // s
constexpr double kNearest = 0.6;  // gaps

/// A drive by the metres driven: the same knots with metres for stamps, turns on the spot left out.
TimedPath by_metres(const TimedPath& drive) {
  TimedPath path;
  double metres = 0.0;
  for (std::size_t i = 0; i < drive.knots.size(); ++i) {
    const Pose2& pose = drive.knots[i].pose;
    if (i > 0) metres += (pose.translation() - drive.knots[i - 1].pose.translation()).norm();
    if (!path.knots.empty() && metres <= path.knots.back().stamp) {
      path.knots.back().pose = pose;
    } else {
      path.knots.push_back({metres, pose});
    }
  }
  return path;
}

/// Metres that a drive has come, over time.
class Odometer {
 public:
  explicit Odometer(const TimedPath& drive) : drive_(drive) {
    for (std::size_t i = 0; i < drive.knots.size(); ++i) {
      const double metres =
          i == 0
              ? 0.0
              : (drive.knots[i].pose.translation() - drive.knots[i - 1].pose.translation()).norm();
      metres_.push_back(i == 0 ? 0.0 : metres_.back() + metres);
    }
  }

  double at(double stamp) const {
    const auto after =
        std::upper_bound(drive_.knots.begin(), drive_.knots.end(), stamp,
                         [](double t, const StampedPose& knot) { return t < knot.stamp; });
    if (after == drive_.knots.begin()) return 0.0;
    if (after == drive_.knots.end()) return metres_.back();
    const auto i = static_cast<std::size_t>(after - drive_.knots.begin());
    const double begin = drive_.knots[i - 1].stamp;
    const double part = (stamp - begin) / (after->stamp - begin);
    return metres_[i - 1] + part * (metres_[i] - metres_[i - 1]);
  }

 private:
  const TimedPath& drive_;
  std::vector<double> metres_;  // at each knot
};

}  // namespace

double add_machine_ahead(World& world, const TimedPath& vehicle,
                         const MachineAheadOptions& options) {
  const TimedPath way = by_metres(vehicle);
  const Odometer odometer(vehicle);
  const double x = 0.5 * options.length_m;
  const double y = 0.5 * options.width_m;
  Mover machine{{{-x, -y}, {x, -y}, {x, y}, {-x, y}}, {}};
  double there = 0.0;
  const auto leave = [&] {
    if (machine.way.knots.size() > 1) {
      there += machine.way.end() - machine.way.begin();
      world.movers.push_back(machine);
    }
    machine.way.knots.clear();
  };
  for (double stamp = vehicle.begin(); stamp <= vehicle.end(); stamp += kStep) {
    const double ahead = odometer.at(stamp) + options.gap_m;
    if (ahead > way.end()) break;
    const Pose2 pose = way.at(ahead);
    const double range = (pose.translation() - vehicle.at(stamp).translation()).norm();
    if (range < kNearest * options.gap_m) {
      leave();
    } else {
      machine.way.knots.push_back({stamp, pose});
    }
  }
  leave();
  return there;
}

}  // namespace adit
