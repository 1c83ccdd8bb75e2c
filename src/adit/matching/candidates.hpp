#pragma once

#include <span>
#include <utility>
#include <vector>

#include "adit/matching/feature_view.hpp"

namespace adit {

/// A sensed and a model feature that satisfy the unary constraints, and what the pair says about
/// the error of the predicted pose.
///
/// A turn of the observer by theta and a move by -u make `turn` = -theta, and of a line `shift` =
/// normal . u and some value in [slide_low, slide_high] = tangent . u, in the model's frame.
struct Candidate {
  FeatureKind kind = FeatureKind::corner;
  int sensed = 0;  ///< index in the views of its kind
  int model = 0;
  int sensed_rank = 0;
  int model_rank = 0;  ///< counted on past the seam at +-pi, so that it grows with the azimuth
  bool has_turn = false;
  double turn = 0.0;        ///< sensed minus model orientation (lines) or bisector (corners), rad
  double turn_noise = 0.0;  ///< squared `noise_sigmas` deviation
  double heading = 0.0;     ///< the turn that is to be expected, from this pair's and the prior
  double heading_noise = 0.0;  ///< its squared deviation
  double shift = 0.0;          ///< sensed minus model perpendicular distance (m)
  double slide_low = 0.0;      ///< the slides along the line that let the two overlap
  double slide_high = 0.0;
};

/// The candidate pairs by sensed rank, then model rank: the paper's ordered list of pairs.
struct CandidateList {
  std::vector<Candidate> pairs;
  /// [first, last) of the pairs of one sensed feature, for each that has any.
  std::vector<std::pair<int, int>> groups;
  bool truncated = false;  ///< `max_candidates` was passed and the list cut
  std::vector<int> buffer;
};

/// Applies the unary constraints to every sensed and model feature; `out` is reused.
void find_candidates(const FeatureViews& sensed, const FeatureViews& model,
                     const MatchingOptions& options, CandidateList& out);

}  // namespace adit
