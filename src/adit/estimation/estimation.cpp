#include "adit/estimation/estimation.hpp"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace adit {
namespace {

constexpr double kLeastScatter = 1e-6;  // exact features scatter by rounding alone

struct Linearised {
  Vector2d error;
  Eigen::Matrix<double, 2, 3> jacobian;
};

/// The paper's two error measures of a line: orientation and perpendicular distance. In the sensed
/// frame: there only the model's exact normal meets the translation. A sensed one, off by its
/// noise, would tell of the way along two parallel walls, which they cannot know.
Linearised line_error(const Vector2d& sensed, const Vector2d& model, const Pose2& pose) {
  const Vector2d normal = unit_vector(model.x());
  Linearised l;
  l.error = {wrap_angle(model.x() - pose.theta - sensed.x()),
             model.y() - normal.dot(pose.translation()) - sensed.y()};
  l.jacobian << 0.0, 0.0, -1.0,  //
      -normal.x(), -normal.y(), 0.0;
  return l;
}

/// The paper's two error measures of a corner: x and y. In the sensed frame, where its covariance
/// does not turn with the pose.
Linearised corner_error(const Vector2d& sensed, const Vector2d& model, const Pose2& pose) {
  const Vector2d axis = unit_vector(pose.theta);
  Matrix2d sensed_from_model;
  sensed_from_model << axis.x(), axis.y(), -axis.y(), axis.x();
  const Vector2d seen = sensed_from_model * (model - pose.translation());
  Linearised l;
  l.error = seen - sensed;
  l.jacobian.leftCols<2>() = -sensed_from_model;
  l.jacobian.col(2) = -perpendicular(seen);
  return l;
}

Linearised error_of(FeatureKind kind, const Vector2d& sensed, const Vector2d& model,
                    const Pose2& pose) {
  return kind == FeatureKind::line ? line_error(sensed, model, pose)
                                   : corner_error(sensed, model, pose);
}

/// Covariance of a line's errors: its points' noise, and the map's line off and turned by
/// independent errors of its two ends, as this piece of it sees them.
Matrix2d line_covariance(const Line& sensed, const Line& model, double map_sigma) {
  Matrix2d covariance = sensed.covariance;
  if (map_sigma <= 0.0) return covariance;
  const double variance = map_sigma * map_sigma;
  const double length = std::max(sensed.length(), 0.5 * model.length());
  const double middle =
      perpendicular(unit_vector(sensed.orientation)).dot(0.5 * (sensed.begin + sensed.end));
  const double turn = 4.0 * variance / (length * length);
  covariance(0, 0) += turn;
  covariance(0, 1) += turn * middle;
  covariance(1, 0) += turn * middle;
  covariance(1, 1) += variance + turn * middle * middle;
  return covariance;
}

Matrix2d corner_covariance(const Corner& sensed, double map_sigma) {
  return sensed.covariance + Matrix2d::Identity() * (map_sigma * map_sigma);
}

bool well_conditioned(const Matrix3d& information) {
  const Eigen::LDLT<Matrix3d> factor(information);
  const Vector3d d = factor.vectorD();
  return factor.info() == Eigen::Success && d.minCoeff() > 1e-9 * std::max(1e-9, d.maxCoeff());
}

}  // namespace

/// What the corner tells beyond the matched lines through it.
Matrix2d FeatureEstimator::corner_information(const Corner& sensed, const FeatureList& list,
                                              const EstimationOptions& options) const {
  if (options.weighting == Weighting::points) return Matrix2d::Identity() * sensed.points;
  const auto is_matched = [&](int arm) {
    return arm >= 0 && matches_of_line_[static_cast<std::size_t>(arm)] > 0;
  };
  const bool first = is_matched(sensed.arms[0]);
  const bool second = is_matched(sensed.arms[1]);
  if (first && second) return Matrix2d::Zero();
  const Matrix2d covariance = corner_covariance(sensed, options.map_sigma_m);
  if (!first && !second) return covariance.inverse();
  const int arm = sensed.arms[first ? 0 : 1];
  const Line& line = list.lines[static_cast<std::size_t>(arm)];
  const Vector2d along = perpendicular(unit_vector(line.orientation));
  return along * along.transpose() / along.dot(covariance * along);
}

void FeatureEstimator::build_terms(const FeatureList& sensed, const FeatureList& model,
                                   std::span<const FeaturePair> pairs,
                                   const EstimationOptions& options) {
  matches_of_line_.assign(sensed.lines.size(), 0);
  for (const FeaturePair& pair : pairs) {
    if (pair.kind == FeatureKind::line) ++matches_of_line_[static_cast<std::size_t>(pair.sensed)];
  }
  const bool by_points = options.weighting == Weighting::points;
  terms_.clear();
  for (const FeaturePair& pair : pairs) {
    const auto i = static_cast<std::size_t>(pair.sensed);
    const auto j = static_cast<std::size_t>(pair.model);
    Term term;
    term.pair = pair;
    if (pair.kind == FeatureKind::line) {
      const Line& s = sensed.lines[i];
      const Line& m = model.lines[j];
      term.sensed = {s.orientation, s.distance};
      term.model = {m.orientation, m.distance};
      term.covariance = line_covariance(s, m, options.map_sigma_m);
      term.information = by_points ? Matrix2d(Matrix2d::Identity() * s.points)
                                   : Matrix2d(term.covariance.inverse() / matches_of_line_[i]);
    } else {
      const Corner& s = sensed.corners[i];
      term.sensed = s.position;
      term.model = model.corners[j].position;
      term.covariance = corner_covariance(s, options.map_sigma_m);
      term.information = corner_information(s, sensed, options);
    }
    terms_.push_back(term);
  }
}

FeatureEstimator::System FeatureEstimator::linearise(
    const Pose2& pose, const std::optional<PoseWithCovariance>& prior) const {
  System system;
  for (const Term& term : terms_) {
    const Linearised l = error_of(term.pair.kind, term.sensed, term.model, pose);
    const Eigen::Matrix<double, 3, 2> weighted = l.jacobian.transpose() * term.information;
    system.information.noalias() += weighted * l.jacobian;
    system.gradient.noalias() += weighted * l.error;
    system.cost += l.error.dot(term.information * l.error);
  }
  if (prior) {
    const Matrix3d information = prior->covariance.inverse();
    const Vector3d error = difference(pose, prior->pose);
    system.information += information;
    system.gradient -= information * error;
    system.cost += error.dot(information * error);
  }
  return system;
}

/// Gauss-Newton: F + J D is least at D = -(J' W J)^-1 J' W F; steps that make it worse are halved.
bool FeatureEstimator::solve(const EstimationOptions& options,
                             const std::optional<PoseWithCovariance>& prior,
                             FeatureFit& fit) const {
  System system = linearise(fit.pose, prior);
  for (int i = 0; i < options.max_iterations; ++i) {
    if (!well_conditioned(system.information)) return false;
    Vector3d step = -system.information.ldlt().solve(system.gradient);
    ++fit.iterations;
    const bool small =
        step.head<2>().norm() < options.step_m && std::abs(step.z()) < options.step_rad;
    if (small) return true;
    Pose2 next = Pose2::from_vector(fit.pose.vector() + step);
    System after = linearise(next, prior);
    for (int halving = 0; after.cost > system.cost && halving < 8; ++halving) {
      step *= 0.5;
      next = Pose2::from_vector(fit.pose.vector() + step);
      after = linearise(next, prior);
    }
    if (!(after.cost <= system.cost * (1.0 + 1e-9) + 1e-12)) return false;
    fit.pose = next;
    system = after;
  }
  return false;
}

/// Takes the pair with the largest error beyond the gate out of those used.
bool FeatureEstimator::drop_worst(const Pose2& pose, double gate) {
  std::size_t worst = terms_.size();
  double largest = gate;
  for (std::size_t i = 0; i < terms_.size(); ++i) {
    const Term& term = terms_[i];
    const Vector2d error = error_of(term.pair.kind, term.sensed, term.model, pose).error;
    const double chi_square = error.dot(term.information * error);
    if (chi_square > largest) {
      largest = chi_square;
      worst = i;
    }
  }
  if (worst == terms_.size()) return false;
  used_.erase(used_.begin() + static_cast<std::ptrdiff_t>(worst));
  return true;
}

/// Weights by point count have no scale of their own: the scatter of the features about their own
/// fit gives it. Only then can they be set against a prior.
void FeatureEstimator::scale_to_scatter(const EstimationOptions& options,
                                        const std::optional<PoseWithCovariance>& prior,
                                        const Pose2& start) {
  FeatureFit alone;
  alone.pose = start;
  if (!solve(options, std::nullopt, alone)) {
    alone.pose = start;
    solve(options, prior, alone);
  }
  const double freedom = std::max(1, count_errors() - 3);
  const double scatter = linearise(alone.pose, std::nullopt).cost / freedom;
  for (Term& term : terms_) term.information /= std::max(scatter, kLeastScatter);
}

FeatureFit FeatureEstimator::fit(const FeatureList& sensed, const FeatureList& model,
                                 std::span<const FeaturePair> pairs, const Pose2& start,
                                 const EstimationOptions& options,
                                 const std::optional<PoseWithCovariance>& prior) {
  FeatureFit fit;
  fit.pose = start;
  used_.assign(pairs.begin(), pairs.end());
  build_terms(sensed, model, used_, options);
  if (options.weighting == Weighting::points) scale_to_scatter(options, prior, start);
  fit.converged = solve(options, prior, fit);
  while (options.weighting == Weighting::covariance && fit.converged &&
         drop_worst(fit.pose, options.gate_chi_square)) {
    ++fit.dropped;
    build_terms(sensed, model, used_, options);
    fit.converged = solve(options, prior, fit);
  }
  const System features = linearise(fit.pose, std::nullopt);
  fit.used = count_sensed();
  fit.information = features.information;
  fit.chi_square = features.cost;
  fit.degrees_of_freedom = std::max(0, count_errors() - 3);
  if (!fit.converged) return fit;
  fit.covariance = options.weighting == Weighting::points
                       ? spread(fit.pose, prior)
                       : Matrix3d(linearise(fit.pose, prior).information.inverse());
  return fit;
}

/// Covariance of a least-squares fit whose weights are not the inverse of its errors' covariance:
/// H^-1 (sum J' W C W J) H^-1, the prior weighted as it is.
Matrix3d FeatureEstimator::spread(const Pose2& pose,
                                  const std::optional<PoseWithCovariance>& prior) const {
  Matrix3d middle = prior ? Matrix3d(prior->covariance.inverse()) : Matrix3d::Zero();
  for (const Term& term : terms_) {
    const Linearised l = error_of(term.pair.kind, term.sensed, term.model, pose);
    const Eigen::Matrix<double, 3, 2> weighted = l.jacobian.transpose() * term.information;
    middle.noalias() += weighted * term.covariance * weighted.transpose();
  }
  const Matrix3d inverse = linearise(pose, prior).information.inverse();
  return inverse * middle * inverse;
}

/// Error measures that tell something; a corner on a matched line has one.
int FeatureEstimator::count_errors() const {
  int errors = 0;
  for (const Term& term : terms_) {
    const double trace = term.information.trace();
    if (trace > 0.0) errors += term.information.determinant() > 1e-12 * trace * trace ? 2 : 1;
  }
  return errors;
}

/// Sensed features that tell something, each once.
int FeatureEstimator::count_sensed() const {
  double sensed = 0.0;
  for (const Term& term : terms_) {
    if (!(term.information.trace() > 0.0)) continue;
    const bool is_line = term.pair.kind == FeatureKind::line;
    sensed += is_line ? 1.0 / matches_of_line_[static_cast<std::size_t>(term.pair.sensed)] : 1.0;
  }
  return static_cast<int>(std::lround(sensed));
}

}  // namespace adit
