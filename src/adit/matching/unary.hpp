#pragma once

#include "adit/matching/feature_view.hpp"

namespace adit {

// The unary constraints (the paper, III-F): what a sensed and a model feature must satisfy to be
// taken for one another, under the error of the predicted pose. Each predicate takes the sensed
// feature first. Those marked (clique) are additions that `paper` mode leaves out.

/// Bound 1: the corners' azimuths differ by no more than `angerr`; in the clique definition, also
/// by what a position error does to the bearing, asin(poserr / distance), and by noise.
bool corner_azimuths_agree(const CornerView& sensed, const CornerView& model);

/// Bound 2: the corners' distances from the observer differ by no more than `poserr` and noise.
bool corner_distances_agree(const CornerView& sensed, const CornerView& model);

/// Bound 3: the angles subtended by the lines overlap once the sensed one is turned by at most
/// `angerr`; in the clique definition each end of the model line may also move by its parallax.
bool subtended_angles_overlap(const LineView& sensed, const LineView& model);

/// Bound 4 (clique): the extents along the lines overlap by `min_overlap` of the shorter one once
/// one is slid by at most `poserr` and noise. At a distance this is tighter than bound 3, because a
/// turn of the observer does not slide a wall.
bool extents_overlap(const LineView& sensed, const LineView& model, const MatchingOptions& options);

/// The slides of the model line along itself (m) that bound 4 allows; empty when low > high.
struct SlideRange {
  double low = 0.0;
  double high = 0.0;
};
SlideRange allowed_slides(const LineView& sensed, const LineView& model,
                          const MatchingOptions& options);

/// Property 1: the concave angles differ by no more than `concerr` and noise, if both corners have
/// one.
bool concave_angles_agree(const CornerView& sensed, const CornerView& model);

/// Property 2: the bisectors' orientations differ by no more than `angerr` and noise, if both
/// corners have one.
bool bisectors_agree(const CornerView& sensed, const CornerView& model);

/// Property 3: the lines' orientations differ by no more than `angerr` and noise.
bool line_orientations_agree(const LineView& sensed, const LineView& model);

/// Property 4: the perpendicular distances differ by no more than `poserr` + `disterr`; in the
/// clique definition the plan's error and the noise that is left when the line is steadied by the
/// predicted heading stand in for `disterr`.
bool line_distances_agree(const LineView& sensed, const LineView& model,
                          const MatchingOptions& options);

/// Property 5 (clique): two corners that each show one arm only show the same one. A sensed corner
/// with one arm may be a model corner with both (clutter hides an arm) and the reverse (a step
/// aside bares it); but to swap one arm for the other the observer must cross the lines of both
/// walls.
bool visible_arms_agree(const Corner& sensed, const Corner& model);

/// Property 6 (clique): where a bisector is missing, the arms that both corners show have
/// orientations that differ by no more than `angerr` and noise. The lists hold the arms' lines.
bool arm_orientations_agree(const Corner& sensed, const FeatureList& sensed_list,
                            const Corner& model, const FeatureList& model_list,
                            const MatchingOptions& options);

/// All that two corners must satisfy.
bool corners_may_match(const CornerView& sensed, const FeatureList& sensed_list,
                       const CornerView& model, const FeatureList& model_list,
                       const MatchingOptions& options);

/// All that two lines must satisfy.
bool lines_may_match(const LineView& sensed, const LineView& model, const MatchingOptions& options);

}  // namespace adit
