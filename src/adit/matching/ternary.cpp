#include "adit/matching/ternary.hpp"

#include <algorithm>
#include <cmath>

namespace adit {
namespace {

// Where two nearly straight walls meet is badly known along them; a place that may be anywhere is
// none.
double corner_noise(const Matrix2d& covariance, const Vector2d& direction,
                    const TernaryTolerances& tolerances) {
  const double noise = tolerances.noise_factor * direction.dot(covariance * direction);
  return std::clamp(noise, 0.0, tolerances.most_corner_noise);
}

// Distance between the intervals [a_low, a_high] and [b_low, b_high]; 0 where they overlap.
double gap(double a_low, double a_high, double b_low, double b_high) {
  return std::max({0.0, a_low - b_high, b_low - a_high});
}

// Squared residual over squared tolerance; not-a-number counts as disagreement.
double ratio(double residual, double tolerance_squared) {
  const double squared = residual * residual;
  if (squared == 0.0) return 0.0;
  return squared <= tolerance_squared ? squared / tolerance_squared : 2.0;
}

}  // namespace

TernaryTolerances ternary_tolerances(const MatchingOptions& options) {
  TernaryTolerances tolerances;
  tolerances.full = options.consistency == Consistency::clique;
  const double distance = tolerances.full ? options.map_disterr : options.terndisterr;
  const double angle = tolerances.full ? options.map_angerr : options.ternangerr;
  tolerances.distance_squared = distance * distance;
  tolerances.angle_squared = angle * angle;
  tolerances.sine_angerr = std::sin(std::clamp(options.angerr, 0.0, 0.5 * kPi));
  tolerances.noise_factor = noise_factor(options);
  tolerances.most_corner_noise = options.terndisterr * options.terndisterr;
  return tolerances;
}

CornersRelation relate(const CornerView& a, const CornerView& b) {
  CornersRelation relation;
  relation.baseline = b.corner->position - a.corner->position;
  relation.distance = relation.baseline.norm();
  return relation;
}

CornersRelation relate(const CornerView& a, const CornerView& b,
                       const TernaryTolerances& tolerances) {
  CornersRelation relation = relate(a, b);
  if (!tolerances.full) return relation;
  const Matrix2d covariance = a.corner->covariance + b.corner->covariance;
  const Vector2d direction =
      relation.distance > 0.0 ? Vector2d(relation.baseline / relation.distance) : Vector2d::UnitX();
  relation.distance_noise = corner_noise(covariance, direction, tolerances);
  relation.lateral_noise = corner_noise(covariance, perpendicular(direction), tolerances);
  return relation;
}

CornerLineRelation relate(const CornerView& corner, const LineView& line) {
  CornerLineRelation relation;
  relation.across = line.normal.dot(corner.corner->position) - line.line->distance;
  relation.along = line.tangent.dot(corner.corner->position);
  return relation;
}

CornerLineRelation relate(const CornerView& corner, const LineView& line,
                          const TernaryTolerances& tolerances) {
  CornerLineRelation relation = relate(corner, line);
  if (!tolerances.full) return relation;
  const Matrix2d& covariance = corner.corner->covariance;
  relation.across_noise = corner_noise(covariance, line.normal, tolerances);
  relation.along_noise = corner_noise(covariance, line.tangent, tolerances);
  return relation;
}

double turns_disagreement(const Candidate& a, const Candidate& b,
                          const TernaryTolerances& tolerances, bool share_sensed) {
  if (!a.has_turn || !b.has_turn) return 0.0;
  const double noise = share_sensed ? 0.0 : a.turn_noise + b.turn_noise;
  return ratio(turn_between(a.turn, b.turn), tolerances.angle_squared + noise);
}

double corners_disagreement(const CornersRelation& sensed, const CornersRelation& model,
                            const TernaryTolerances& tolerances) {
  const double distance =
      ratio(sensed.distance - model.distance, tolerances.distance_squared + sensed.distance_noise);
  if (!tolerances.full || distance > 1.0) return distance;
  const double slack_squared = tolerances.distance_squared + sensed.lateral_noise;
  // Where the second sensed corner lies as seen from the model's baseline.
  const double dot = sensed.baseline.dot(model.baseline);
  const double lateral = std::abs(cross(model.baseline, sensed.baseline));
  const double allowed = tolerances.sine_angerr * sensed.distance + std::sqrt(slack_squared);
  if (lateral > allowed * model.distance) return 2.0;
  if (dot < 0.0 && sensed.distance * sensed.distance > slack_squared) return 2.0;
  return distance;
}

double corner_line_disagreement(const CornerLineRelation& sensed, const CornerLineRelation& model,
                                const Candidate& corner_pair, const Candidate& line_pair,
                                const LineView& sensed_line, const TernaryTolerances& tolerances) {
  const double base = tolerances.distance_squared;
  if (!tolerances.full) return ratio(sensed.across - model.across, base);
  const SteadiedLine line = steady(sensed_line, turn_between(corner_pair.heading, line_pair.turn),
                                   corner_pair.heading_noise + tolerances.angle_squared);
  // The line turns about the place where it is known best; the corner stays.
  const double arm = sensed.along - sensed_line.lever;
  const double across =
      ratio(sensed.across + arm * line.turn - model.across,
            base + sensed.across_noise + sensed_line.centroid_noise + arm * arm * line.turn_noise);
  if (across > 1.0) return across;
  const double slide = sensed.along - sensed.across * line.turn - model.along;
  const double along =
      ratio(gap(slide, slide, line_pair.slide_low, line_pair.slide_high),
            base + sensed.along_noise + sensed.across * sensed.across * line.turn_noise);
  return std::max(across, along);
}

namespace {

// What a pair of lines says of the observer's move: n . u, and a range of t . u.
struct Move {
  double shift = 0.0;
  double low = 0.0;
  double high = 0.0;
  double shift_noise = 0.0;
  double slide_noise = 0.0;
};

Move move_of(const Candidate& pair, const LineView& sensed, const Candidate& other,
             double angle_squared) {
  const SteadiedLine line =
      steady(sensed, turn_between(other.heading, pair.turn), other.heading_noise + angle_squared);
  return {pair.shift + line.shift, pair.slide_low + line.slide, pair.slide_high + line.slide,
          line.shift_noise, line.slide_noise};
}

// Two pairs with one sensed line share its noise: it is not an excuse for either.
Move plain_move_of(const Candidate& pair) {
  return {pair.shift, pair.slide_low, pair.slide_high, 0.0, 0.0};
}

// With (c, s) the direction of b's normal in a's axes: shift_b = c shift_a + s slide_a.
double shift_disagreement(const Move& a, const Move& b, double c, double s, double base) {
  const auto [low, high] = std::minmax({s * a.low, s * a.high});
  const double left = b.shift - c * a.shift;
  return ratio(gap(left, left, low, high),
               base + b.shift_noise + c * c * a.shift_noise + s * s * a.slide_noise);
}

// The same for the slide: slide_b = c slide_a - s shift_a.
double slide_disagreement(const Move& a, const Move& b, double c, double s, double base) {
  const auto [low, high] = std::minmax({c * a.low, c * a.high});
  return ratio(gap(low - s * a.shift, high - s * a.shift, b.low, b.high),
               base + b.slide_noise + c * c * a.slide_noise + s * s * a.shift_noise);
}

}  // namespace

double lines_disagreement(const Candidate& a, const LineView& sensed_a, const LineView& model_a,
                          const Candidate& b, const LineView& sensed_b, const LineView& model_b,
                          const TernaryTolerances& tolerances, bool share_sensed) {
  const double base = tolerances.distance_squared;
  const double angle = tolerances.angle_squared;
  const Move move_a = share_sensed ? plain_move_of(a) : move_of(a, sensed_a, b, angle);
  const Move move_b = share_sensed ? plain_move_of(b) : move_of(b, sensed_b, a, angle);
  const double c = model_a.normal.dot(model_b.normal);
  const double s = cross(model_a.normal, model_b.normal);
  const double forth = shift_disagreement(move_a, move_b, c, s, base);
  if (forth > 1.0) return forth;
  const double back = shift_disagreement(move_b, move_a, c, -s, base);
  if (back > 1.0) return back;
  return std::max({forth, back, slide_disagreement(move_a, move_b, c, s, base)});
}

bool are_collinear(const LineView& a, const LineView& b, const TernaryTolerances& tolerances) {
  const double turn = turn_between(a.line->orientation, b.line->orientation);
  const double offset = b.line->distance - a.line->distance;
  return turn * turn <= tolerances.angle_squared && offset * offset <= tolerances.distance_squared;
}

bool are_one_corner(const CornerView& a, const CornerView& b, const TernaryTolerances& tolerances) {
  const auto& arms_a = a.corner->arms;
  const auto& arms_b = b.corner->arms;
  const bool complementary = (arms_a[0] < 0) != (arms_a[1] < 0) &&
                             (arms_b[0] < 0) != (arms_b[1] < 0) &&
                             (arms_a[0] < 0) != (arms_b[0] < 0);
  const CornersRelation relation = relate(a, b, tolerances);
  return complementary && relation.distance * relation.distance <=
                              tolerances.distance_squared + relation.distance_noise;
}

}  // namespace adit
