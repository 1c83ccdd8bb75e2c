#include "adit/simulation/dead_reckoning.hpp"

#include <Eigen/Cholesky>
#include <algorithm>

#include "adit/motion/pose_history.hpp"

namespace adit {
namespace {

constexpr double kRecoveryStep = 0.1;  // s between the knots of the way back

}  // namespace

Vector3d draw_move_error(const Pose2& move, const OdometryNoise& noise, Random& random) {
  const double a = random.normal();
  const double b = random.normal();
  const double c = random.normal();
  // LDLT rather than LLT: a machine at rest with noise in proportion only has no error at all.
  const Eigen::LDLT<Matrix3d> factors(move_covariance(move, noise));
  const Vector3d scaled =
      factors.vectorD().cwiseMax(0.0).cwiseSqrt().cwiseProduct(Vector3d(a, b, c));
  const Vector3d permuted = factors.matrixL() * scaled;
  return factors.transpositionsP().transpose() * permuted;
}

Pose2 reported_move(const Pose2& move, double slip_ratio, const Vector3d& error,
                    const OdometryFaults& lasting) {
  const Vector2d scaled = (1.0 + lasting.odometry_scale) * move.translation();
  const Vector2d translation = (1.0 + slip_ratio) * scaled + error.head<2>();
  const double turn =
      (1.0 + lasting.turn_scale) * move.theta + lasting.turn_bias * move.translation().norm();
  return {translation.x(), translation.y(), wrap_angle(turn + error.z())};
}

TimedPath without_jumps(const TimedPath& path) {
  TimedPath felt;
  for (std::size_t i = 0; i < path.knots.size(); ++i) {
    const StampedPose& knot = path.knots[i];
    if (i == 0) {
      felt.knots.push_back(knot);
      continue;
    }
    const StampedPose& before = path.knots[i - 1];
    if (knot.stamp == before.stamp) continue;  // a jump: the wheels stay where they were
    felt.knots.push_back({knot.stamp, felt.knots.back().pose * (inverse(before.pose) * knot.pose)});
  }
  return felt;
}

TimedPath with_hop(const TimedPath& path, double stamp, const Pose2& hop, double recovery_s) {
  const auto displaced = [&](double t) {
    const double left = std::clamp(1.0 - (t - stamp) / recovery_s, 0.0, 1.0);
    return path.at(t) * interpolate(Pose2{}, hop, left);
  };
  TimedPath hopped;
  for (const StampedPose& knot : path.knots) {
    if (knot.stamp < stamp) hopped.knots.push_back(knot);
  }
  hopped.knots.push_back({stamp, path.at(stamp)});
  for (double t = stamp; t < std::min(stamp + recovery_s, path.end()); t += kRecoveryStep) {
    hopped.knots.push_back({t, displaced(t)});
  }
  for (const StampedPose& knot : path.knots) {
    if (knot.stamp > stamp) hopped.knots.push_back({knot.stamp, displaced(knot.stamp)});
  }
  std::stable_sort(hopped.knots.begin(), hopped.knots.end(),
                   [](const StampedPose& a, const StampedPose& b) { return a.stamp < b.stamp; });
  return hopped;
}

}  // namespace adit
