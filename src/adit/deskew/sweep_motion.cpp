#include "adit/deskew/sweep_motion.hpp"

#include <algorithm>
#include <cmath>

#include "adit/scan/sweep_timing.hpp"

namespace adit {
namespace {

struct TimeSpan {
  double begin = 0.0;
  double end = 0.0;

  double length() const { return end - begin; }
};

/// As long as the sweep and as near to it as the odometry allows; shorter where that is shorter.
TimeSpan covered(const TimeSpan& sweep, const TimeSpan& odometry) {
  const double end = std::clamp(sweep.end, odometry.begin, odometry.end);
  const double begin = std::clamp(sweep.begin, odometry.begin, odometry.end);
  return {std::max(odometry.begin, std::min(begin, end - sweep.length())),
          std::min(odometry.end, std::max(end, begin + sweep.length()))};
}

/// The stamps of the poses between which the history interpolates.
TimeSpan support(std::span<const StampedPose> poses, const TimeSpan& span) {
  const auto first_after =
      std::upper_bound(poses.begin(), poses.end(), span.begin,
                       [](double time, const StampedPose& p) { return time < p.stamp; });
  const auto first_not_before =
      std::lower_bound(poses.begin(), poses.end(), span.end,
                       [](const StampedPose& p, double time) { return p.stamp < time; });
  return {(first_after - 1)->stamp, first_not_before->stamp};
}

SweepMotion unknown(const SweepMotionOptions& options) {
  SweepMotion motion;
  const Vector3d sigma(options.speed_sigma_m_per_s, options.speed_sigma_m_per_s,
                       options.turn_rate_sigma_rad_per_s);
  motion.covariance = sigma.cwiseAbs2().asDiagonal();
  return motion;
}

/// Whether it is a move that the vehicle could have made, told more surely than a guess.
bool says_something(const SweepMotion& motion, const SweepMotionOptions& options) {
  const Vector3d guess = unknown(options).covariance.diagonal();
  const Vector3d fastest = options.max_sigmas * guess.cwiseSqrt();
  const bool is_surer = (motion.covariance.diagonal().array() < guess.array()).all();
  return is_surer && (motion.twist.vector().cwiseAbs().array() <= fastest.array()).all();
}

}  // namespace

SweepMotion sweep_motion(const PoseHistory& odometry, double stamp, const ScannerModel& scanner,
                         const OdometryNoise& noise, const SweepMotionOptions& options) {
  const std::span<const StampedPose> poses = odometry.poses();
  const double first_s = sweep_timing(scanner, 1).first_s;
  const TimeSpan sweep{stamp + first_s, stamp + first_s + scanner.sweep_s};
  const bool has_sweep = sweep.length() > 0.0 && std::isfinite(sweep.begin + sweep.end);
  if (poses.size() < 2 || !has_sweep) return unknown(options);

  const TimeSpan span = covered(sweep, {poses.front().stamp, poses.back().stamp});
  const Pose2 move = inverse(*odometry.at(span.begin, 0.0)) * *odometry.at(span.end, 0.0);
  const TimeSpan told = support(poses, span);
  const double lag = 0.5 * (std::abs(told.begin - sweep.begin) + std::abs(told.end - sweep.end));
  const Vector3d drift(options.acceleration_m_per_s2 * lag, options.acceleration_m_per_s2 * lag,
                       options.turn_acceleration_rad_per_s2 * lag);

  SweepMotion motion;
  motion.twist = twist_between(move, span.length());
  motion.covariance = move_covariance(move, noise) / (span.length() * span.length());
  motion.covariance.diagonal() += drift.cwiseAbs2();
  motion.known = true;
  return says_something(motion, options) ? motion : unknown(options);
}

}  // namespace adit
