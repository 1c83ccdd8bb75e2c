#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "adit/refinement/beam_priors.hpp"
#include "adit/refinement/beam_residuals.hpp"

namespace adit {

/// What the beams met, in beams.
struct BeamCounts {
  double wall = 0.0;       ///< the wall of the map
  double before = 0.0;     ///< something before it
  double behind = 0.0;     ///< something behind it: the wall is not there
  double no_return = 0.0;  ///< nothing that came back
  double between = 0.0;    ///< of those on the wall, any of several walls that stand close
  double unmapped = 0.0;   ///< something where the map has nothing at all
  double mapped = 0.0;     ///< wall, before and behind together: returns, counted one by one
  double returns() const { return mapped + unmapped; }
};

/// What a scan came to, once its beams are classified.
struct BeamSummary {
  BeamCounts counts;
  /// What the evidence would be on average if every return came from the map's wall.
  double expected_log_evidence = 0.0;
};

/// Log of the density of all returns under "something else", against one that does not ask the map:
/// added to the evidence it compares poses that see other walls.
double log_other(std::span<const BeamResidual> beams, const BeamPriors& priors);

/// Which beams met the wall of the map, as probabilities.
///
/// Three classes in a chain along the sweep: the map's wall, something else, or a wall behind one
/// that is gone. What stands in the way, or is gone, covers a run of neighbouring beams, so that a
/// beam's neighbours speak for it too (forward and backward pass of a hidden Markov model). A beam
/// without return says nothing.
class BeamClassifier {
 public:
  /// `variances`: of each residual if it met the wall.
  void classify(std::span<const BeamResidual> beams, std::span<const double> variances,
                const BeamPriors& priors);

  /// Probability of each beam to have met the map's wall, or the one behind it that its residual
  /// is of; 0 without return.
  std::span<const double> on_wall() const { return {on_wall_.data(), size_}; }
  /// Log of the probability density of all returns under all classes, against "something else"
  /// everywhere: what the map explains of the scan.
  double log_evidence() const { return log_evidence_; }
  /// Of the beams that were classified last.
  BeamSummary summary(std::span<const BeamResidual> beams) const;

 private:
  void find_ratios(std::span<const BeamResidual> beams, std::span<const double> variances,
                   const BeamPriors& priors);
  void run_chain(const BeamPriors& priors);
  void run_backward(const Matrix3d& next);

  Eigen::ArrayXd ratio_;    // of the densities, wall against something else; 1 says nothing
  Eigen::ArrayXd beyond_;   // the same for a wall behind one that is gone
  Eigen::ArrayXd peak_;     // of these, for a residual of none
  Eigen::ArrayXd on_wall_;  // the chain's messages: for the wall, then for either wall ...
  Eigen::ArrayXd gone_;     // ... for the one behind it ...
  Eigen::ArrayXd other_;    // ... for something else
  std::size_t size_ = 0;
  double log_evidence_ = 0.0;
};

}  // namespace adit
