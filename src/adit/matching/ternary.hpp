#pragma once

#include "adit/matching/candidates.hpp"

namespace adit {

// The comparisons of two pairs that make the ternary constraint (the paper, III-F): a pair is
// compared with the two pairs before it. Each returns a disagreement: the largest squared residual
// over its squared tolerance, so that 1 is the limit of agreement. None depends on the pose.

/// Squared tolerances of the comparisons, before the noise of the sensed features is added.
struct TernaryTolerances {
  double distance_squared = 0.0;   ///< m²
  double angle_squared = 0.0;      ///< rad²
  double sine_angerr = 0.0;        ///< sine of the largest heading error
  double noise_factor = 0.0;       ///< of the sensed variances; 0 for `paper`
  double most_corner_noise = 0.0;  ///< m²; what a corner's noise may excuse
  bool full = false;               ///< with the comparisons that the clique definition adds
};

/// The tolerances that belong to the options.
TernaryTolerances ternary_tolerances(const MatchingOptions& options);

/// How two corners lie to each other.
struct CornersRelation {
  Vector2d baseline = Vector2d::Zero();  ///< from the first to the second (m)
  double distance = 0.0;
  double distance_noise = 0.0;  ///< squared deviation of the distance, times the noise factor
  double lateral_noise = 0.0;   ///< the same across the baseline
};

/// How a corner lies to a line.
struct CornerLineRelation {
  double across = 0.0;  ///< distance of the corner from the line, positive beyond it (m)
  double along = 0.0;   ///< its place along the line, from the foot of the observer's perpendicular
  double across_noise = 0.0;  ///< squared deviations from the corner's own noise
  double along_noise = 0.0;
};

/// The relation of two corners of one list, its noise left at zero.
CornersRelation relate(const CornerView& a, const CornerView& b);

/// The relation of two sensed corners with their noise.
CornersRelation relate(const CornerView& a, const CornerView& b,
                       const TernaryTolerances& tolerances);

/// The relation of a corner and a line of one list, its noise left at zero.
CornerLineRelation relate(const CornerView& corner, const LineView& line);

/// The relation of a sensed corner and line with the corner's noise.
CornerLineRelation relate(const CornerView& corner, const LineView& line,
                          const TernaryTolerances& tolerances);

/// Difference of the pairs' turns: 0 if one of them has none. This is the difference in orientation
/// between two lines, or between a line and a corner's bisector, sensed minus model.
/// `share_sensed`: both pairs hold the same sensed feature, whose noise then cancels.
double turns_disagreement(const Candidate& a, const Candidate& b,
                          const TernaryTolerances& tolerances, bool share_sensed);

/// Corner to corner: equal distances; (clique) the baseline turned by no more than `angerr`.
double corners_disagreement(const CornersRelation& sensed, const CornersRelation& model,
                            const TernaryTolerances& tolerances);

/// Corner to line: equal distances of the corner from the line, on the same side; (clique) the
/// slide along the line that the corner shows lets the line's pair overlap. The line is steadied by
/// the heading that the corner's pair expects.
double corner_line_disagreement(const CornerLineRelation& sensed, const CornerLineRelation& model,
                                const Candidate& corner_pair, const Candidate& line_pair,
                                const LineView& sensed_line, const TernaryTolerances& tolerances);

/// Line to line (clique): some move of the observer brings both sensed lines onto their model lines
/// and lets both overlap them. For parallel walls this compares the differences of perpendicular
/// distances; for others, where the walls cross. Each line is steadied by the heading that the
/// other's pair expects.
double lines_disagreement(const Candidate& a, const LineView& sensed_a, const LineView& model_a,
                          const Candidate& b, const LineView& sensed_b, const LineView& model_b,
                          const TernaryTolerances& tolerances, bool share_sensed);

/// Two model lines that one sensed line may be at once: collinear within the plain tolerances.
bool are_collinear(const LineView& a, const LineView& b, const TernaryTolerances& tolerances);

/// Two sensed corners that may be one corner of the map: at the same place within noise, each
/// showing the arm that the other lacks, as where the scan breaks at a sharp edge.
bool are_one_corner(const CornerView& a, const CornerView& b, const TernaryTolerances& tolerances);

}  // namespace adit
