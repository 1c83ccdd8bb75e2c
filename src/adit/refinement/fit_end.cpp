// What is left to do when the steps of a fit have ended.

#include <algorithm>
#include <cmath>

#include "adit/refinement/refinement.hpp"
#include "adit/refinement/sweep_equations.hpp"

namespace adit {

/// The normal equations if every beam's error were its own.
template <int N>
NormalEquations<N> Refiner::white_equations() const {
  const std::span<const BeamResidual> beams = residuals_.beams();
  const RigidTransform map_from_vehicle(fit_.pose);
  NormalEquations<N> white;
  for (std::size_t k = 0; k < beams.size(); ++k) {
    const double probability = classifier_.on_wall()[k];
    if (probability < kLeastProbability) continue;
    const auto gradient = parameters_gradient<N>(beams[k], map_from_vehicle, fit_.correction);
    white.add(gradient, beams[k].residual, probability / noise_[k]);
  }
  white.mirror();
  return white;
}

Matrix3d Refiner::white_information(const RefinementInput& input) const {
  if (!input.motion) return white_equations<3>().information;
  NormalEquations<9> white = white_equations<9>();
  add_motion_prior(*input.motion, fit_.correction, white);
  return marginal(white, gain_of(white)).information;
}

/// Carries the fit to where the last step leads, as if all were linear as far as that: a step of a
/// few sigma is short against all that the map shows. On the move the shares of single walls leave
/// out what the sweep's correction takes along.
void Refiner::take_last_step(bool moving) {
  const Vector3d move = difference(fit_.pose, next_);
  const auto gain = [&](const Vector3d& score, const Matrix3d& information) {
    return move.dot(score) - 0.5 * move.dot(information * move);
  };
  fit_.chi_square -= 2.0 * gain(fit_.score, fit_.information);
  fit_.score -= fit_.information * move;
  for (WallShare& share : shares_) {
    NormalEquations<3>& its = share.equations;
    its.chi_square -= 2.0 * gain(its.score, its.information);
    its.score -= its.information * move;
  }
  double likelier = 0.0;
  if (moving) {
    Eigen::Matrix<double, 9, 1> all;
    all << move, (next_correction_.halves[0].vector() - fit_.correction.halves[0].vector()),
        (next_correction_.halves[1].vector() - fit_.correction.halves[1].vector());
    likelier = shift_beams<9>(all);
  } else {
    likelier = shift_beams<3>(move);
  }
  fit_.log_evidence += likelier;
  fit_.log_likelihood += likelier;
  fit_.pose = next_;
  fit_.correction = next_correction_;
}

/// Moves the walls that the beams should meet; how much likelier those make the beams on walls.
template <int N>
double Refiner::shift_beams(const Eigen::Matrix<double, N, 1>& move) {
  const RigidTransform map_from_vehicle(fit_.pose);
  const std::span<BeamResidual> beams = residuals_.beams();
  double likelier = 0.0;
  for (std::size_t k = 0; k < beams.size(); ++k) {
    BeamResidual& beam = beams[k];
    const double farther =
        parameters_gradient<N>(beam, map_from_vehicle, fit_.correction).dot(move);
    beam.range += farther;
    if (!beam.has_return) continue;
    likelier += classifier_.on_wall()[k] * farther * (beam.residual - 0.5 * farther) / spread_[k];
    beam.residual -= farther;
  }
  return likelier;
}

void Refiner::count_beams() {
  const BeamSummary summary = classifier_.summary(residuals_.beams());
  fit_.counts = summary.counts;
  fit_.counts.unmapped = residuals_.unmapped();
  fit_.counts.between = count_between();
  fit_.log_evidence = classifier_.log_evidence();
  fit_.expected_log_evidence = summary.expected_log_evidence;
}

/// Beams that the plan leaves several walls to have met, too close to be told apart: its walls are
/// drawn twice.
double Refiner::count_between() const {
  constexpr double kTold = 0.1;  // of the noise's variance
  const std::span<const BeamResidual> beams = residuals_.beams();
  double between = 0.0;
  for (std::size_t k = 0; k < beams.size(); ++k) {
    if (beams[k].wall_variance > kTold * noise_[k]) between += classifier_.on_wall()[k];
  }
  return between;
}

std::span<const int> Refiner::worst_walls(std::size_t most) {
  constexpr double kFewBeamsOff = 3.0;
  off_wall_.clear();
  const std::span<const BeamResidual> beams = residuals_.beams();
  for (std::size_t k = 0; k < beams.size(); ++k) {
    if (!beams[k].has_return) continue;
    const int wall = beams[k].wall;
    auto known = std::find_if(off_wall_.begin(), off_wall_.end(),
                              [&](const auto& entry) { return entry.first == wall; });
    if (known == off_wall_.end()) known = off_wall_.insert(known, {wall, 0.0});
    known->second += 1.0 - classifier_.on_wall()[k];
  }
  std::sort(off_wall_.begin(), off_wall_.end(), [](const auto& a, const auto& b) {
    return a.second != b.second ? a.second > b.second : a.first < b.first;
  });
  worst_walls_.clear();
  for (const auto& [wall, beams_off] : off_wall_) {
    if (worst_walls_.size() < most && beams_off > kFewBeamsOff) worst_walls_.push_back(wall);
  }
  return worst_walls_;
}

}  // namespace adit
