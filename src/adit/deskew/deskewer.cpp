#include "adit/deskew/deskewer.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace adit {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// First bearing and mean step of beams with bearings of their own.
void describe_fan(LaserScan& scan) {
  const std::size_t n = scan.bearings.size();
  if (n == 0) return;
  scan.first_bearing = scan.bearings.front();
  if (n == 1) return;
  scan.bearing_step = (scan.bearings.back() - scan.bearings.front()) / static_cast<double>(n - 1);
}

}  // namespace

void Deskewer::deskew(const LaserScan& scan, const ScannerModel& scanner, const Twist2& twist,
                      const DeskewOptions& options, LaserScan& out) {
  out = scan;  // into the vectors that it has
  const Twist2 laser_twist = twist_of_mounted(twist, scan.vehicle_from_laser);
  const bool moves = laser_twist.is_finite() && !laser_twist.vector().isZero(0.0);
  if (!moves || !(scanner.sweep_s > 0.0) || !std::isfinite(scanner.sweep_s)) return;
  limits_ = return_limits(scan, scanner);
  prepare_directions(scan);
  const SweepTiming timing = sweep_timing(scanner, scan.ranges.size());
  carry_beams(scan, timing, laser_twist, out);
  lay_slots(scan, laser_twist.omega * timing.first_s);
  find_surfaces(out, options.surface_beams);
  drop_hidden(options.hidden_depth_m + options.hidden_sigmas * scanner.beam_sigma_m(), out);
  describe_fan(out);
}

void Deskewer::prepare_directions(const LaserScan& scan) {
  const std::size_t n = scan.ranges.size();
  const bool same_fan = evenly_spaced_ && scan.bearings.empty() && directions_.size() == n &&
                        first_bearing_ == scan.first_bearing && bearing_step_ == scan.bearing_step;
  if (same_fan) return;
  evenly_spaced_ = scan.bearings.empty();
  first_bearing_ = scan.first_bearing;
  bearing_step_ = scan.bearing_step;
  directions_.resize(n);
  for (std::size_t i = 0; i < n; ++i) directions_[i] = unit_vector(scan.bearing(i));
}

void Deskewer::carry_beams(const LaserScan& scan, const SweepTiming& timing,
                           const Twist2& laser_twist, LaserScan& out) const {
  out.bearings.resize(scan.ranges.size());
  RigidTransform stamp_from_then(moved(laser_twist, timing.first_s));
  const RigidTransform onward(moved(laser_twist, timing.step_s));
  for (std::size_t i = 0; i < scan.ranges.size(); ++i) {
    out.bearings[i] = scan.bearing(i) + laser_twist.omega * timing.at(i);
    const double range = scan.ranges[i];
    if (limits_.is_return(range)) {
      // Split along and across the turned beam: the parallax is small, however far the bearings
      // run.
      const Vector2d beam = stamp_from_then.direction(directions_[i]);
      const double along = range + beam.dot(stamp_from_then.origin);
      const double across = cross(beam, stamp_from_then.origin);
      out.ranges[i] = std::sqrt(along * along + across * across);
      out.bearings[i] += std::atan2(across, along);
    }
    stamp_from_then = stamp_from_then * onward;
  }
}

/// The depth buffer's slots are the beams as they would lie without parallax, and a quarter of the
/// fan more at each side.
void Deskewer::lay_slots(const LaserScan& scan, double turn) {
  const std::size_t n = scan.ranges.size();
  const std::size_t margin = n / 4 + 1;
  slots_per_radian_ = 1.0 / scan.bearing_step;
  first_slot_ = scan.bearing(0) + turn - static_cast<double>(margin) * scan.bearing_step;
  nearest_.assign(n + 2 * margin, kInfinity);
}

/// Enters each pair of neighbouring returns into the slots between them.
void Deskewer::find_surfaces(const LaserScan& scan, int widest) {
  const double last_slot = static_cast<double>(nearest_.size() - 1);
  std::size_t before = scan.ranges.size();  // the return before, none yet
  for (std::size_t i = 0; i < scan.ranges.size(); ++i) {
    if (!limits_.is_return(scan.ranges[i])) continue;
    const std::size_t first = std::exchange(before, i);
    if (first >= i || i - first > static_cast<std::size_t>(widest)) continue;
    const double from = slot(scan.bearings[first]);
    const double to = slot(scan.bearings[i]);
    if (!(to - from <= widest) || !(from >= 0.0) || !(to <= last_slot)) continue;
    const double farther = std::max(scan.ranges[first], scan.ranges[i]);
    for (double k = std::ceil(from); k <= to; k += 1.0) {
      double& nearest = nearest_[static_cast<std::size_t>(k)];
      nearest = std::min(nearest, farther);
    }
  }
}

/// A return is hidden where the slots on both sides of it are: an edge that the motion has not
/// moved past another hides nothing, however near it lies.
void Deskewer::drop_hidden(double depth, LaserScan& scan) const {
  const double last_slot = static_cast<double>(nearest_.size() - 1);
  for (std::size_t i = 0; i < scan.ranges.size(); ++i) {
    if (!limits_.is_return(scan.ranges[i])) continue;
    const double at = slot(scan.bearings[i]);
    if (!(at >= 0.0) || !(at <= last_slot)) continue;
    const double surface = std::max(nearest_[static_cast<std::size_t>(std::floor(at))],
                                    nearest_[static_cast<std::size_t>(std::ceil(at))]);
    if (scan.ranges[i] > surface + depth) scan.ranges[i] = kInfinity;
  }
}

}  // namespace adit
