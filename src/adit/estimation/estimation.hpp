#pragma once

#include <optional>
#include <span>
#include <vector>

#include "adit/features/features.hpp"
#include "adit/geometry/pose2.hpp"

namespace adit {

/// How much each feature counts.
enum class Weighting {
  covariance,  ///< by what its points' noise lets it tell (the paper's future work)
  points,      ///< by its number of range points (the paper)
};

struct EstimationOptions {
  Weighting weighting = Weighting::covariance;
  double map_sigma_m = 0.05;
  double gate_chi_square = 16.0;
  int max_iterations = 20;
  double step_m = 1e-6;
  double step_rad = 1e-7;

  template <class Self, class Field>
  static void visit(Self& self, Field&& field) {
    field("weighting", self.weighting, "'covariance' or, as in the paper, 'points'");
    field("gate_chi_square", self.gate_chi_square,
          "a pair whose error has a larger chi-square is dropped, the worst first; 16 loses one "
          "good pair in 3,000");
    field("max_iterations", self.max_iterations, "Gauss-Newton steps before giving up");
    field("step_m", self.step_m, "converged when a step is shorter than this (m)");
    field("step_rad", self.step_rad, "and turns less than this (rad)");
  }
};

/// Outcome of a fit of sensed to model features.
struct FeatureFit {
  bool converged = false;
  Pose2 pose;                               ///< model_from_sensed
  Matrix3d covariance = Matrix3d::Zero();   ///< over (x, y, theta) in the model's axes
  Matrix3d information = Matrix3d::Zero();  ///< of the features alone, without the prior
  double chi_square = 0.0;                  ///< of the features used
  int degrees_of_freedom = 0;               ///< of the features used: errors minus three
  int used = 0;                             ///< sensed features that count in the solution
  int dropped = 0;                          ///< pairs beyond the gate
  int iterations = 0;
};

/// Position estimation (the paper, III-G): the pose that minimises the error of all pairs, by
/// Gauss-Newton over both error measures of each feature: orientation and perpendicular distance of
/// a line, x and y of a corner. Converges from up to 90 degrees away.
///
/// With covariance weighting each range point counts once: a corner tells only what the matched
/// lines through it do not tell already. Keeps its buffers between calls.
class FeatureEstimator {
 public:
  /// Fits from `start`. A `prior`, in the same frame, is one more observation of the pose; without
  /// one, pairs that do not fix all three parameters leave `converged` false.
  FeatureFit fit(const FeatureList& sensed, const FeatureList& model,
                 std::span<const FeaturePair> pairs, const Pose2& start,
                 const EstimationOptions& options,
                 const std::optional<PoseWithCovariance>& prior = std::nullopt);

  /// The pairs that count in the last fit, after gating.
  std::span<const FeaturePair> pairs_used() const { return used_; }

 private:
  /// One pair's error, two numbers, with their information.
  struct Term {
    FeaturePair pair;
    Vector2d sensed;       // (orientation, distance) or (x, y)
    Vector2d model;        // the same of the model's feature
    Matrix2d information;  // weight of the error; singular where only one direction is told
    Matrix2d covariance;   // of the error, as the features' points tell it
  };
  struct System {
    Matrix3d information = Matrix3d::Zero();
    Vector3d gradient = Vector3d::Zero();
    double cost = 0.0;
  };

  void build_terms(const FeatureList& sensed, const FeatureList& model,
                   std::span<const FeaturePair> pairs, const EstimationOptions& options);
  Matrix2d corner_information(const Corner& sensed, const FeatureList& list,
                              const EstimationOptions& options) const;
  System linearise(const Pose2& pose, const std::optional<PoseWithCovariance>& prior) const;
  bool solve(const EstimationOptions& options, const std::optional<PoseWithCovariance>& prior,
             FeatureFit& fit) const;
  bool drop_worst(const Pose2& pose, double gate);
  void scale_to_scatter(const EstimationOptions& options,
                        const std::optional<PoseWithCovariance>& prior, const Pose2& start);
  Matrix3d spread(const Pose2& pose, const std::optional<PoseWithCovariance>& prior) const;
  int count_errors() const;
  int count_sensed() const;

  std::vector<Term> terms_;
  std::vector<int> matches_of_line_;  // of each sensed line
  std::vector<FeaturePair> used_;
};

}  // namespace adit
