#include "adit/matching/unary.hpp"

#include <gtest/gtest.h>

namespace adit {
namespace {

constexpr double kEps = 1e-9;

MatchingOptions paper() {
  MatchingOptions options;
  options.consistency = Consistency::paper;
  return options;
}

MatchingOptions exact_clique() {
  MatchingOptions options;
  options.map_disterr = 0.0;
  options.map_angerr = 0.0;
  return options;
}

Corner corner_at(double distance, double azimuth) {
  Corner corner;
  corner.position = distance * unit_vector(azimuth);
  return corner;
}

// A wall across the ray at `orientation`, from `low` to `high` along its tangent.
Line wall(double orientation, double distance, double low, double high) {
  Line line;
  const Vector2d normal = unit_vector(orientation);
  line.orientation = orientation;
  line.distance = distance;
  line.begin = distance * normal + low * perpendicular(normal);
  line.end = distance * normal + high * perpendicular(normal);
  return line;
}

bool azimuths(const Corner& sensed, const Corner& model, const MatchingOptions& options) {
  return corner_azimuths_agree(view_of(sensed, options), view_of(model, options));
}

TEST(CornerAzimuth, PaperAllowsAngerrAndNoMore) {
  const MatchingOptions options = paper();
  EXPECT_TRUE(azimuths(corner_at(5.0, 1.0 + options.angerr - kEps), corner_at(5.0, 1.0), options));
  EXPECT_FALSE(azimuths(corner_at(5.0, 1.0 + options.angerr + 1e-6), corner_at(5.0, 1.0), options));
  EXPECT_FALSE(azimuths(corner_at(1.1, 1.2), corner_at(1.1, 1.0), options));
}

TEST(CornerAzimuth, CliqueAddsTheParallaxOfANearCorner) {
  MatchingOptions options = exact_clique();
  options.poserr = 1.0;
  const double limit = options.angerr + std::asin(1.0 / 4.0);
  EXPECT_TRUE(azimuths(corner_at(4.0, limit - kEps), corner_at(4.0, 0.0), options));
  EXPECT_FALSE(azimuths(corner_at(4.0, limit + 1e-6), corner_at(4.0, 0.0), options));
  // Nearer than the position error a corner may lie in any direction.
  EXPECT_TRUE(azimuths(corner_at(0.9, kPi), corner_at(0.9, 0.0), options));
}

TEST(CornerAzimuth, CliqueAddsTheNoiseOfTheSensedCorner) {
  MatchingOptions options = exact_clique();
  options.poserr = 0.0;
  Corner sensed = corner_at(5.0, 0.0);
  sensed.covariance(1, 1) = 0.01;  // across the ray; 3 sigma are 0.3 m of 5 m
  const double limit = options.angerr + std::asin(0.3 / 5.0);
  EXPECT_TRUE(azimuths(sensed, corner_at(5.0, limit - kEps), options));
  EXPECT_FALSE(azimuths(sensed, corner_at(5.0, limit + 1e-6), options));
}

TEST(CornerAzimuth, WrapsAtTheSeam) {
  EXPECT_TRUE(azimuths(corner_at(5.0, kPi - 0.02), corner_at(5.0, -kPi + 0.02), paper()));
  EXPECT_FALSE(azimuths(corner_at(5.0, kPi - 0.05), corner_at(5.0, -kPi + 0.05), paper()));
}

TEST(CornerDistance, AllowsPoserrAndTheRadialNoise) {
  MatchingOptions options = exact_clique();
  Corner sensed = corner_at(5.0, 0.0);
  const auto agree = [&](double distance) {
    return corner_distances_agree(view_of(sensed, options),
                                  view_of(corner_at(distance, 0.0), options));
  };
  EXPECT_TRUE(agree(6.0 - kEps));
  EXPECT_TRUE(agree(4.0 + kEps));
  EXPECT_FALSE(agree(6.0 + 1e-6));
  EXPECT_FALSE(agree(4.0 - 1e-6));
  sensed.covariance(1, 1) = 0.01;  // across the ray: no help
  EXPECT_FALSE(agree(6.0 + 1e-6));
  sensed.covariance(0, 0) = 0.01;  // along it
  EXPECT_TRUE(agree(6.3 - kEps));
  EXPECT_FALSE(agree(6.3 + 1e-6));
  options.consistency = Consistency::paper;
  EXPECT_FALSE(agree(6.0 + 1e-6));
}

TEST(SubtendedAngle, PaperTurnsTheSensedLineByAngerr) {
  const MatchingOptions options = paper();
  // The model line spans azimuths -45 to 45 degrees.
  const Line model = wall(0.0, 2.0, -2.0, 2.0);
  const auto overlaps = [&](double azimuth, double width) {
    Line sensed;
    sensed.begin = 3.0 * unit_vector(azimuth);
    sensed.end = 3.0 * unit_vector(azimuth + width);
    return subtended_angles_overlap(view_of(sensed, options), view_of(model, options));
  };
  const double edge = 0.25 * kPi + options.angerr;
  EXPECT_TRUE(overlaps(0.0, 0.1));
  EXPECT_TRUE(overlaps(edge - 1e-6, 0.1));
  EXPECT_FALSE(overlaps(edge + 1e-6, 0.1));
  EXPECT_TRUE(overlaps(-edge - 0.1 + 1e-6, 0.1));
  EXPECT_FALSE(overlaps(-edge - 0.1 - 1e-6, 0.1));
  EXPECT_TRUE(overlaps(-1.2, 2.4)) << "the sensed line overlaps the model line on both sides";
  EXPECT_FALSE(overlaps(kPi - 0.2, 0.4));
}

TEST(SubtendedAngle, CliqueAddsTheParallaxOfEachEnd) {
  MatchingOptions options = exact_clique();
  options.poserr = 0.5;
  const Line model = wall(0.0, 2.0, -2.0, 2.0);
  const double edge = 0.25 * kPi + options.angerr + std::asin(0.5 / std::hypot(2.0, 2.0));
  const auto overlaps = [&](double azimuth) {
    Line sensed;
    sensed.begin = 3.0 * unit_vector(azimuth);
    sensed.end = 3.0 * unit_vector(azimuth + 0.1);
    return subtended_angles_overlap(view_of(sensed, options), view_of(model, options));
  };
  EXPECT_TRUE(overlaps(edge - 1e-6));
  EXPECT_FALSE(overlaps(edge + 1e-6));
}

TEST(SubtendedAngle, HoldsAcrossTheSeam) {
  const MatchingOptions options = paper();
  const Line model = wall(kPi, 2.0, -1.0, 1.0);
  const Line sensed = wall(-kPi + 0.05, 2.0, -1.0, 1.0);
  EXPECT_TRUE(subtended_angles_overlap(view_of(sensed, options), view_of(model, options)));
}

TEST(Extents, MustOverlapByTheirShareAfterASlideOfPoserr) {
  MatchingOptions options = exact_clique();
  options.poserr = 0.5;
  options.min_overlap = 0.5;
  const Line model = wall(0.3, 4.0, 0.0, 3.0);
  const auto overlap = [&](double low, double length) {
    return extents_overlap(view_of(wall(0.3, 4.0, low, low + length), options),
                           view_of(model, options), options);
  };
  EXPECT_TRUE(overlap(0.5, 1.0));
  EXPECT_TRUE(overlap(3.0 + 0.5 - 0.5 - kEps, 1.0));
  EXPECT_FALSE(overlap(3.0 + 0.5 - 0.5 + 1e-6, 1.0));
  EXPECT_FALSE(overlap(-0.5 - 0.5 - 1e-6, 1.0));
  EXPECT_TRUE(overlap(-10.0, 20.0));
}

TEST(ConcaveAngle, AllowsConcerrAndNoise) {
  MatchingOptions options = exact_clique();
  Corner sensed = corner_at(5.0, 0.0);
  Corner model = corner_at(5.0, 0.0);
  model.concave_angle = 1.5;
  const auto agree = [&](double angle) {
    sensed.concave_angle = angle;
    return concave_angles_agree(view_of(sensed, options), view_of(model, options));
  };
  EXPECT_TRUE(agree(1.5 + options.concerr - kEps));
  EXPECT_FALSE(agree(1.5 + options.concerr + 1e-6));
  sensed.concave_angle_sigma = 0.1;
  EXPECT_TRUE(agree(1.5 + options.concerr + 0.3 - kEps));
  EXPECT_FALSE(agree(1.5 + options.concerr + 0.3 + 1e-6));
  options = paper();
  EXPECT_FALSE(agree(1.5 + options.concerr + 1e-6));
  sensed.concave_angle.reset();
  EXPECT_TRUE(concave_angles_agree(view_of(sensed, options), view_of(model, options)));
}

TEST(Bisector, AllowsAngerrAndNoiseAndWraps) {
  MatchingOptions options = exact_clique();
  Corner sensed = corner_at(5.0, 0.0);
  Corner model = corner_at(5.0, 0.0);
  model.bisector = kPi - 0.01;
  const auto agree = [&](double bisector) {
    sensed.bisector = wrap_angle(bisector);
    return bisectors_agree(view_of(sensed, options), view_of(model, options));
  };
  EXPECT_TRUE(agree(kPi - 0.01 + options.angerr - kEps));
  EXPECT_FALSE(agree(kPi - 0.01 + options.angerr + 1e-6));
  sensed.bisector_sigma = 0.05;
  EXPECT_TRUE(agree(kPi - 0.01 + options.angerr + 0.15 - kEps));
  EXPECT_FALSE(agree(kPi - 0.01 + options.angerr + 0.15 + 1e-6));
  model.bisector.reset();
  EXPECT_TRUE(agree(0.0));
}

TEST(LineOrientation, AllowsAngerrAndNoise) {
  MatchingOptions options = exact_clique();
  const Line model = wall(-3.1, 4.0, -1.0, 1.0);
  const auto agree = [&](double turn, double variance) {
    Line sensed = wall(wrap_angle(-3.1 + turn), 4.0, -1.0, 1.0);
    sensed.covariance(0, 0) = variance;
    return line_orientations_agree(view_of(sensed, options), view_of(model, options));
  };
  EXPECT_TRUE(agree(-options.angerr + kEps, 0.0));
  EXPECT_FALSE(agree(-options.angerr - 1e-6, 0.0));
  EXPECT_TRUE(agree(-options.angerr - 0.3 + 1e-6, 0.01));
  EXPECT_FALSE(agree(-options.angerr - 0.3 - 1e-6, 0.01));
  options.consistency = Consistency::paper;
  EXPECT_FALSE(agree(-options.angerr - 1e-6, 0.01));
}

TEST(LineDistance, PaperAllowsPoserrAndDisterr) {
  const MatchingOptions options = paper();
  const auto agree = [&](double distance) {
    return line_distances_agree(view_of(wall(0.0, distance, -1.0, 1.0), options),
                                view_of(wall(0.0, 4.0, -1.0, 1.0), options), options);
  };
  EXPECT_TRUE(agree(5.5 - kEps));
  EXPECT_FALSE(agree(5.5 + 1e-6));
}

TEST(LineDistance, CliqueAllowsPoserrAndNoise) {
  MatchingOptions options;
  options.map_disterr = 0.4;
  Line sensed = wall(0.0, 4.0, -1.0, 1.0);
  sensed.covariance(1, 1) = 0.01;  // 3 sigma = 0.3; with the plan's 0.4 it makes 0.5
  const auto agree = [&](double distance) {
    return line_distances_agree(view_of(sensed, options),
                                view_of(wall(0.0, distance, -1.0, 1.0), options), options);
  };
  EXPECT_TRUE(agree(4.0 + options.poserr + 0.5 - 1e-6));
  EXPECT_FALSE(agree(4.0 + options.poserr + 0.5 + 1e-6));
}

// A short piece far from its foot: its distance is off by two metres only because its orientation
// is off, and the predicted heading knows better.
TEST(LineDistance, CliqueSteadiesAShortLineByThePredictedHeading) {
  MatchingOptions options = exact_clique();
  options.poserr = 0.2;
  options.angerr = 0.01;
  const double lever = 10.0;
  const Line model = wall(0.0, 4.0, 8.0, 12.0);
  const auto sensed_turned = [&](double turn, double offset) {
    const Vector2d middle(4.0 + offset, lever);
    const Vector2d half = 0.2 * perpendicular(unit_vector(turn));
    Line line;
    line.orientation = turn;
    line.distance = unit_vector(turn).dot(middle);
    line.begin = middle - half;
    line.end = middle + half;
    const double along = perpendicular(unit_vector(turn)).dot(middle);
    line.covariance << 0.04, along * 0.04, along * 0.04, along * along * 0.04 + 1e-4;
    return line;
  };
  const auto agree = [&](double turn, double offset) {
    return line_distances_agree(view_of(sensed_turned(turn, offset), options),
                                view_of(model, options), options);
  };
  EXPECT_GT(std::abs(sensed_turned(0.2, 0.0).distance - 4.0), 1.8);
  EXPECT_TRUE(agree(0.2, 0.0));
  EXPECT_TRUE(agree(0.0, 0.0));
  EXPECT_FALSE(agree(0.0, 0.8)) << "its own orientation's noise must not excuse its place";
}

TEST(VisibleArms, OneArmIsNotTheOther) {
  Corner before;
  before.arms = {0, -1};
  Corner after;
  after.arms = {-1, 0};
  Corner both;
  both.arms = {0, 1};
  const Corner none;
  EXPECT_TRUE(visible_arms_agree(before, before));
  EXPECT_FALSE(visible_arms_agree(before, after));
  EXPECT_FALSE(visible_arms_agree(after, before));
  EXPECT_TRUE(visible_arms_agree(both, after));
  EXPECT_TRUE(visible_arms_agree(before, both));
  EXPECT_TRUE(visible_arms_agree(none, before));
}

TEST(ArmOrientations, StandInForAMissingBisector) {
  const MatchingOptions options = exact_clique();
  FeatureList sensed_list;
  FeatureList model_list;
  model_list.lines = {wall(0.0, 4.0, -1.0, 1.0)};
  Corner sensed = corner_at(4.0, 0.2);
  Corner model = sensed;
  sensed.arms = model.arms = {0, -1};
  const auto agree = [&](double turn) {
    sensed_list.lines = {wall(turn, 4.0, -1.0, 1.0)};
    return arm_orientations_agree(sensed, sensed_list, model, model_list, options);
  };
  EXPECT_TRUE(agree(options.angerr - kEps));
  EXPECT_FALSE(agree(options.angerr + 1e-6));
  model.arms = {-1, 0};
  EXPECT_TRUE(agree(options.angerr + 1e-6)) << "no arm in common";
  sensed.arms = {7, -1};
  model.arms = {0, -1};
  EXPECT_TRUE(agree(0.0)) << "an index that the list does not have";
}

TEST(UnaryConstraints, RejectNotANumber) {
  const MatchingOptions options;
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const FeatureList none;
  EXPECT_FALSE(corners_may_match(view_of(corner_at(nan, 0.0), options), none,
                                 view_of(corner_at(4.0, 0.0), options), none, options));
  EXPECT_FALSE(lines_may_match(view_of(wall(nan, 4.0, -1.0, 1.0), options),
                               view_of(wall(0.0, 4.0, -1.0, 1.0), options), options));
}

TEST(TolerancesFromPrior, AreSigmasOfTheWorstDirection) {
  Matrix3d covariance = Matrix3d::Zero();
  covariance.topLeftCorner<2, 2>() << 0.05, 0.03, 0.03, 0.05;  // eigenvalues 0.08 and 0.02
  covariance(2, 2) = 0.0004;
  MatchingOptions base;
  base.prior_sigmas = 3.0;
  base.min_angerr = 0.01;
  const MatchingOptions options = tolerances_from_prior(base, covariance);
  EXPECT_NEAR(options.poserr, 3.0 * std::sqrt(0.08), 1e-12);
  EXPECT_NEAR(options.angerr, 0.06, 1e-12);
}

TEST(TolerancesFromPrior, HaveFloorsAndCaps) {
  const MatchingOptions base;
  const MatchingOptions floors = tolerances_from_prior(base, Matrix3d::Zero());
  EXPECT_EQ(floors.poserr, base.min_poserr);
  EXPECT_EQ(floors.angerr, base.min_angerr);
  const MatchingOptions caps = tolerances_from_prior(base, 1e6 * Matrix3d::Identity());
  EXPECT_EQ(caps.poserr, base.max_poserr);
  EXPECT_EQ(caps.angerr, base.max_angerr);
  const double infinity = std::numeric_limits<double>::infinity();
  const MatchingOptions unknown = tolerances_from_prior(base, infinity * Matrix3d::Identity());
  EXPECT_EQ(unknown.poserr, base.max_poserr);
  EXPECT_EQ(unknown.angerr, base.max_angerr);
}

TEST(TolerancesFromPrior, LeaveThePaperAlone) {
  const MatchingOptions options = tolerances_from_prior(paper(), Matrix3d::Zero());
  EXPECT_EQ(options.poserr, 1.0);
  EXPECT_EQ(options.angerr, paper().angerr);
}

}  // namespace
}  // namespace adit
