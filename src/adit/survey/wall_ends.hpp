#pragma once

#include <vector>

#include "adit/survey/wall_evidence.hpp"
#include "adit/survey/walls.hpp"

namespace adit {

/// Lets open ends meet the walls beside them: an end that runs past another wall by less than
/// `corner_gap_m` stops there, and one that stops so far before it goes on to it, unless beams went
/// through between. All ends are judged by the walls as given, so that their order does not count.
void join_ends(std::vector<SurveyedWallLine>& lines, BeamEvidence& evidence,
               const WallOptions& options);

}  // namespace adit
