#include "adit/survey/drive_survey.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <exception>
#include <string>

#include "adit/motion/pose_history.hpp"

namespace adit {
namespace {

constexpr double kClosureRobustSigmas = 3.0;
constexpr double kRefutedChiSquare = 40.0;  // of a closure that the solved graph does not bear out
constexpr int kSolverIterations = 50;

PoseConstraint constraint_of(const Closure& c) {
  return {c.from, c.to, c.from_to, c.information, kClosureRobustSigmas};
}

}  // namespace

DriveSurvey::DriveSurvey(const OdometryNoise& noise, const DriveSurveyOptions& options)
    : options_(options), tracker_(noise, options.tracking, options.surface, options.alignment) {}

void DriveSurvey::add(const LaserScan& scan, const ScannerModel& scanner,
                      const Pose2& odom_from_vehicle) {
  if (tracker_.scans().empty()) map_from_drive_ = odom_from_vehicle;
  tracker_.add(scan, scanner, odom_from_vehicle);
}

void DriveSurvey::know_place(std::size_t scan, const Pose2& map_from_vehicle,
                             const Matrix3d& covariance) {
  const TrackedScan& at = tracker_.scans()[scan];
  // One of a keyframe will do: the first is its own, or the one nearest after it.
  if (!known_.empty() && known_.back().keyframe == at.keyframe) return;
  const Pose2 place = map_from_vehicle * inverse(at.keyframe_from_scan);
  const Vector2d arm = place.translation() - map_from_vehicle.translation();
  Matrix3d carry_by = Matrix3d::Identity();
  carry_by(0, 2) = -arm.y();
  carry_by(1, 2) = arm.x();
  known_.push_back({at.keyframe, place, carry_by * covariance * carry_by.transpose()});
}

std::vector<PoseConstraint> DriveSurvey::chain() const {
  std::vector<PoseConstraint> out;
  const auto& keyframes = tracker_.keyframes();
  for (std::size_t i = 1; i < keyframes.size(); ++i) {
    const Keyframe& k = keyframes[i];
    const Matrix3d information = k.tracked_information + k.odometry_covariance.inverse();
    const Matrix3d floor = Vector3d(1e-4, 1e-4, 4e-6).asDiagonal();
    out.push_back({i - 1, i, k.previous_from_this, (information.inverse() + floor).inverse(), 0.0});
  }
  return out;
}

std::vector<PoseConstraint> DriveSurvey::dead_reckoning() const {
  std::vector<PoseConstraint> out;
  const auto& keyframes = tracker_.keyframes();
  for (std::size_t i = 1; i < keyframes.size(); ++i) {
    const Keyframe& k = keyframes[i];
    out.push_back({i - 1, i, k.odometry, k.odometry_covariance.inverse(), 1.0});
  }
  return out;
}

void DriveSurvey::solve_for(std::span<const PoseConstraint> constraints) {
  solved_ = solve_pose_graph(poses_, constraints, kSolverIterations).usable && solved_;
}

bool DriveSurvey::close_loops_within(double limit_m, int threads) {
  std::vector<PoseConstraint> constraints = chain();
  for (const Closure& c : closures_) constraints.push_back(constraint_of(c));
  const DriftBound drift(poses_.size(), constraints);
  const LoopScene scene{tracker_.keyframes(), poses_, drift, limit_m};
  const std::vector<Closure> found =
      search_loops(scene, closures_, options_.loops, options_.alignment, threads);
  const std::vector<Closure> accepted = consistent_set(scene, found, closures_, options_.loops);
  if (accepted.empty()) return false;
  for (const Closure& c : accepted) {
    closures_.push_back(c);
    constraints.push_back(constraint_of(c));
  }
  solve_for(constraints);
  const std::size_t before = closures_.size();
  std::erase_if(closures_, [&](const Closure& c) {
    return squared_error(constraint_of(c), poses_[c.from], poses_[c.to]) > kRefutedChiSquare;
  });
  if (closures_.size() < before) {
    constraints = chain();
    for (const Closure& c : closures_) constraints.push_back(constraint_of(c));
    solve_for(constraints);
  }
  return true;
}

void DriveSurvey::close_loops(double most_drift_m, int threads, const DriveProgress& progress) {
  const LoopOptions& loops = options_.loops;
  constexpr int kTries = 2;
  for (double limit = loops.first_limit_m; limit <= most_drift_m; limit *= 2.0) {
    for (int i = 0; i < kTries; ++i) {
      progress("closing loops", std::log(limit / loops.first_limit_m) /
                                    std::log(2.0 * most_drift_m / loops.first_limit_m));
      if (!close_loops_within(limit, threads)) break;
    }
  }
}

void DriveSurvey::register_jointly(int threads, const DriveProgress& progress) {
  std::vector<PoseConstraint> backbone = chain();
  for (const Closure& c : closures_) backbone.push_back(constraint_of(c));
  for (int round = 0; round < options_.joint.rounds; ++round) {
    progress("laying all scans onto each other",
             static_cast<double>(round) / options_.joint.rounds);
    constraints_ = register_pairs(tracker_.keyframes(), poses_, backbone, options_.joint,
                                  options_.alignment, threads);
    pairs_ = constraints_.size();
    for (const PoseConstraint& c : dead_reckoning()) constraints_.push_back(c);
    solve_for(constraints_);
  }
}

/// How many steps from one keyframe to the next did not survive: where closures were false, walls
/// pull the drive apart at its weakest place.
std::size_t DriveSurvey::torn() const {
  constexpr double kTornChiSquare = 100.0;
  constexpr double kTornMetres = 0.5;
  std::size_t count = 0;
  for (const PoseConstraint& c : chain()) {
    const Pose2 step = inverse(poses_[c.from]) * poses_[c.to];
    const double apart = difference(c.from_to, step).head<2>().norm();
    count += apart > kTornMetres && squared_error(c, poses_[c.from], poses_[c.to]) > kTornChiSquare;
  }
  return count;
}

void DriveSurvey::solve(double most_drift_m, int threads, const DriveProgress& progress) {
  poses_.clear();
  closures_.clear();
  solved_ = true;
  for (const Keyframe& k : tracker_.keyframes()) poses_.push_back(k.pose);
  close_loops(most_drift_m, threads, progress);
  register_jointly(threads, progress);
}

void DriveSurvey::solve_in_map() {
  if (known_.empty()) return;
  const GraphSummary solution = solve_with_known_places(poses_, constraints_, known_,
                                                        options_.known_places, kSolverIterations);
  solved_ = solution.usable && solved_;
  map_from_drive_ = {};
}

/// On the way between two keyframes both say where a scan was; the nearer counts more.
Pose2 DriveSurvey::pose_of(const TrackedScan& scan) const {
  const std::size_t before = scan.keyframe;
  const auto& keyframes = tracker_.keyframes();
  const Pose2 by_last = poses_[before] * scan.keyframe_from_scan;
  if (before + 1 == keyframes.size()) return by_last;
  const Keyframe& next = keyframes[before + 1];
  const double start = tracker_.scans()[keyframes[before].scan].way_m;
  const double whole = tracker_.scans()[next.scan].way_m - start;
  if (whole <= 0.0) return by_last;
  const Pose2 by_next =
      poses_[before + 1] * inverse(next.previous_from_this) * scan.keyframe_from_scan;
  return interpolate(by_last, by_next, std::clamp((scan.way_m - start) / whole, 0.0, 1.0));
}

/// Of each keyframe against those around it: what its constraints say together. They share the
/// errors of the walls that they are about, so that many tell no more than a few.
std::vector<Matrix3d> DriveSurvey::covariances() const {
  constexpr double kIndependent = 4.0;  // of the constraints of one keyframe
  std::vector<Matrix3d> information(poses_.size(), Matrix3d::Zero());
  std::vector<double> counts(poses_.size(), 0.0);
  for (const PoseConstraint& c : constraints_) {
    Matrix3d rotation = Matrix3d::Identity();
    const Vector2d axis = unit_vector(poses_[c.from].theta);
    rotation.topLeftCorner<2, 2>() << axis.x(), -axis.y(), axis.y(), axis.x();
    const double share = robust_share(c, poses_[c.from], poses_[c.to]);
    const Matrix3d of_it = share * rotation * c.information * rotation.transpose();
    information[c.to] += of_it;
    counts[c.to] += share;
  }
  std::vector<Matrix3d> out(poses_.size(), Matrix3d::Zero());
  for (std::size_t i = 0; i < poses_.size(); ++i) {
    if (counts[i] <= 0.0) continue;  // the first of a drive that was never seen again
    const double shared = std::max(1.0, counts[i] / kIndependent);
    const Matrix3d least = 1e-6 * Matrix3d::Identity();  // what nothing holds stays invertible
    out[i] = (information[i] / shared + least).inverse();
  }
  return out;
}

DriveResult DriveSurvey::result() const {
  DriveResult out;
  const std::vector<Matrix3d> covariances_of = covariances();
  for (const TrackedScan& scan : tracker_.scans()) {
    Matrix3d turn = Matrix3d::Identity();
    const Vector2d axis = unit_vector(map_from_drive_.theta);
    turn.topLeftCorner<2, 2>() << axis.x(), -axis.y(), axis.y(), axis.x();
    out.poses.push_back(
        {map_from_drive_ * pose_of(scan), turn * covariances_of[scan.keyframe] * turn.transpose()});
  }
  for (const Keyframe& k : tracker_.keyframes()) out.keyframes.push_back(k.scan);
  out.closures = closures_;
  out.pairs = pairs_;
  return out;
}

void DriveSurvey::solve_all(int threads, const DriveProgress& progress) {
  const LoopOptions& loops = options_.loops;
  solve(loops.last_limit_m, threads, progress);
  // Closures over less drift are surer: rather few that are true than many of which some are not.
  std::size_t fewest = torn();
  double best = loops.last_limit_m;
  double last = best;
  for (double limit = best / 4.0; fewest > 0 && last > loops.first_limit_m; limit /= 4.0) {
    last = std::max(limit, loops.first_limit_m);
    solve(last, threads, progress);
    if (torn() >= fewest) continue;
    fewest = torn();
    best = last;
  }
  if (last != best) solve(best, threads, progress);
  solve_in_map();
}

Result<DriveResult> DriveSurvey::finish(int threads, const DriveProgress& progress) {
  try {
    const DriveProgress unheard = [](const char*, double) {};
    solve_all(threads, progress ? progress : unheard);
    if (!solved_) {
      return fail("the poses of the drive cannot be solved for: its scans or odometry contradict");
    }
    return result();
  } catch (const std::exception& error) {
    return fail(std::string("the survey of the drive failed: ") + error.what());
  }
}

}  // namespace adit
