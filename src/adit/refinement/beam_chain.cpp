#include "adit/refinement/beam_chain.hpp"

namespace adit {

Matrix3d transition(const BeamPriors& priors, std::size_t beams) {
  const double gone = priors.gone_ratio;
  const double kept = 1.0 - gone;
  const double leave = kept * priors.leave_ratio;
  const double back = kept * priors.back_ratio;
  Matrix3d step;
  step << kept - leave, leave, gone,  //
      back, kept - back, gone,        //
      back, gone, kept - back;
  Matrix3d all = step;
  for (std::size_t i = 1; i < beams; ++i) all *= step;
  return all;
}

Vector3d steady_state(const BeamPriors& priors) {
  const Matrix3d step = transition(priors);
  const double away = 1.0 - step(Met::kWall, Met::kWall);
  const double back = step(Met::kOther, Met::kWall);
  const double gone = priors.gone_ratio;
  const double wall = back / (back + away);
  const double other = (wall * step(Met::kWall, Met::kOther) + (1.0 - wall) * gone) /
                       (1.0 - step(Met::kOther, Met::kOther) + gone);
  return {wall, other, 1.0 - wall - other};
}

}  // namespace adit
