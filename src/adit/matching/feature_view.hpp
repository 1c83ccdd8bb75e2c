#pragma once

#include <vector>

#include "adit/features/features.hpp"
#include "adit/matching/matching_options.hpp"

namespace adit {

/// A corner with what the constraints ask of it again and again, computed once a scan.
///
/// The gates are whole tolerances of the unary constraints: the error of the predicted pose plus,
/// in the clique definition, the plan's error and this corner's own noise.
struct CornerView {
  const Corner* corner = nullptr;
  int index = 0;          ///< in the list's corners
  int rank = 0;           ///< in the list's order
  double azimuth = 0.0;   ///< rad
  double distance = 0.0;  ///< from the observer (m)
  double parallax = 0.0;  ///< how far a position error may turn its bearing (rad); 0 for `paper`
  double azimuth_gate = 0.0;
  double distance_gate = 0.0;
  double concave_gate = 0.0;
  double bisector_gate = 0.0;
};

/// A line with what the constraints ask of it again and again, computed once a scan.
///
/// `along_begin` and `along_end` are the coordinates of its ends on itself, counted from the foot
/// of the observer's perpendicular: like `distance`, a turn of the observer leaves them as they
/// are.
struct LineView {
  const Line* line = nullptr;
  int index = 0;
  int rank = 0;
  double azimuth = 0.0;
  Vector2d normal = Vector2d::UnitX();   ///< away from the observer
  Vector2d tangent = Vector2d::UnitY();  ///< counter-clockwise
  double along_begin = 0.0;
  double along_end = 0.0;
  double begin_azimuth = 0.0;
  double subtended = 0.0;       ///< angle from begin counter-clockwise to end, in [0, 2 pi)
  double begin_parallax = 0.0;  ///< as the corner's, for each end
  double end_parallax = 0.0;
  double azimuth_gate = 0.0;
  double orientation_gate = 0.0;
  double orientation_noise = 0.0;  ///< squared `noise_sigmas` deviation; 0 in `paper` mode
  double centroid_noise = 0.0;     ///< of the distance where the line is known best
  double lever = 0.0;              ///< coordinate of that place on the line (m)
};

/// What is left of a sensed line's error once the heading is known from elsewhere.
///
/// A short line's orientation is poor, and extrapolated to the foot of the perpendicular so is its
/// distance; but the two err together, so knowing the one corrects the other.
struct SteadiedLine {
  double turn = 0.0;        ///< correction of the orientation (rad)
  double shift = 0.0;       ///< of the distance (m)
  double slide = 0.0;       ///< of the coordinates along the line (m)
  double turn_noise = 0.0;  ///< what is left, as squared `noise_sigmas` deviations
  double shift_noise = 0.0;
  double slide_noise = 0.0;
};

/// Corrects a line whose orientation differs by `turn` from where a heading known with the squared
/// deviation `noise` puts it.
SteadiedLine steady(const LineView& line, double turn, double noise);

/// A feature list as the matcher sees it: corners and lines apart, each in the list's order.
struct FeatureViews {
  std::vector<CornerView> corners;
  std::vector<LineView> lines;
  std::vector<FeatureRef> order;  ///< as the list's, but `index` counts in the arrays above
  const FeatureList* features = nullptr;
};

/// The view of one corner, which must outlive it.
CornerView view_of(const Corner& corner, const MatchingOptions& options);

/// The view of one line, which must outlive it.
LineView view_of(const Line& line, const MatchingOptions& options);

/// The views of a list; `out` is reused. Features that are not finite are left out.
void make_views(const FeatureList& features, const MatchingOptions& options, FeatureViews& out);

/// Squared factor of the sensed variances: `noise_sigmas` squared, or 0 in `paper` mode.
inline double noise_factor(const MatchingOptions& options) {
  if (options.consistency == Consistency::paper) return 0.0;
  return options.noise_sigmas * options.noise_sigmas;
}

/// The difference of two angles of (-pi, pi], wrapped.
inline double turn_between(double from, double to) {
  const double turn = to - from;
  if (turn > kPi) return turn - kTwoPi;
  return turn <= -kPi ? turn + kTwoPi : turn;
}

}  // namespace adit
