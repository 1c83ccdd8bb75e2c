#include "adit/matching/ternary.hpp"

#include <gtest/gtest.h>

namespace adit {
namespace {

MatchingOptions paper() {
  MatchingOptions options;
  options.consistency = Consistency::paper;
  return options;
}

MatchingOptions clique() {
  MatchingOptions options;
  options.map_disterr = 0.2;
  options.map_angerr = 0.05;
  return options;
}

Corner corner_at(double x, double y) {
  Corner corner;
  corner.position = {x, y};
  return corner;
}

Line wall(double orientation, double distance, double low, double high) {
  Line line;
  const Vector2d normal = unit_vector(orientation);
  line.orientation = orientation;
  line.distance = distance;
  line.begin = distance * normal + low * perpendicular(normal);
  line.end = distance * normal + high * perpendicular(normal);
  return line;
}

// The pairs of two features each, as the matcher would make them.
struct Pairs {
  Pairs(const FeatureList& sensed_list, const FeatureList& model_list,
        const MatchingOptions& options) {
    sensed_sorted = sensed_list;
    model_sorted = model_list;
    sort_counter_clockwise(sensed_sorted);
    sort_counter_clockwise(model_sorted);
    make_views(sensed_sorted, options, sensed);
    make_views(model_sorted, options, model);
    find_candidates(sensed, model, options, candidates);
  }
  FeatureList sensed_sorted;
  FeatureList model_sorted;
  FeatureViews sensed;
  FeatureViews model;
  CandidateList candidates;
};

double corners(double sensed_distance, double model_distance, const MatchingOptions& options,
               double variance = 0.0, double turn = 0.0) {
  Corner a = corner_at(3.0, 0.0);
  Corner b = corner_at(3.0, sensed_distance);
  b.covariance = variance * Matrix2d::Identity();
  const Corner c = corner_at(2.0, 1.0);
  Corner d = c;
  d.position += model_distance * Vector2d(-std::sin(turn), std::cos(turn));
  const TernaryTolerances tolerances = ternary_tolerances(options);
  return corners_disagreement(relate(view_of(a, options), view_of(b, options), tolerances),
                              relate(view_of(c, options), view_of(d, options)), tolerances);
}

TEST(Corners, PaperComparesDistances) {
  EXPECT_LE(corners(4.0, 4.5 - 1e-9, paper()), 1.0);
  EXPECT_GT(corners(4.0, 4.5 + 1e-6, paper()), 1.0);
  EXPECT_LE(corners(4.0, 4.5 - 1e-9, paper(), 0.0, 2.0), 1.0)
      << "whichever way the baseline points";
}

TEST(Corners, CliqueAddsNoiseInQuadrature) {
  EXPECT_LE(corners(4.0, 4.2 - 1e-9, clique()), 1.0);
  EXPECT_GT(corners(4.0, 4.2 + 1e-6, clique()), 1.0);
  const double limit = std::hypot(0.2, 3.0 * 0.1);
  EXPECT_LE(corners(4.0, 4.0 + limit - 1e-9, clique(), 0.01), 1.0);
  EXPECT_GT(corners(4.0, 4.0 + limit + 1e-6, clique(), 0.01), 1.0);
}

TEST(Corners, CliqueExcusesNoMoreThanTerndisterrByNoise) {
  const double limit = std::hypot(0.2, clique().terndisterr);
  EXPECT_LE(corners(4.0, 4.0 + limit - 1e-9, clique(), 25.0), 1.0);
  EXPECT_GT(corners(4.0, 4.0 + limit + 1e-6, clique(), 25.0), 1.0);
}

TEST(Corners, CliqueLetsTheBaselineTurnByAngerr) {
  const MatchingOptions options = clique();
  EXPECT_LE(corners(4.0, 4.0, options, 0.0, options.angerr), 1.0);
  EXPECT_GT(corners(4.0, 4.0, options, 0.0, options.angerr + 0.06), 1.0);
  EXPECT_GT(corners(4.0, 4.0, options, 0.0, kPi), 1.0);
}

Candidate turned(double turn, double noise = 0.0) {
  Candidate pair;
  pair.has_turn = true;
  pair.turn = turn;
  pair.turn_noise = noise;
  return pair;
}

TEST(Turns, AgreeWithinTernangerr) {
  const TernaryTolerances of_paper = ternary_tolerances(paper());
  const double angle = paper().ternangerr;
  EXPECT_LE(turns_disagreement(turned(0.01), turned(0.01 + angle - 1e-9), of_paper, false), 1.0);
  EXPECT_GT(turns_disagreement(turned(0.01), turned(0.01 + angle + 1e-6), of_paper, false), 1.0);
  EXPECT_LE(turns_disagreement(turned(kPi - 0.02), turned(-kPi + 0.02), of_paper, false), 1.0);
  EXPECT_EQ(turns_disagreement(turned(1.0), Candidate{}, of_paper, false), 0.0);
}

TEST(Turns, CliqueAddsNoiseUnlessItIsShared) {
  const TernaryTolerances tolerances = ternary_tolerances(clique());
  const double limit = std::sqrt(0.05 * 0.05 + 0.01 + 0.02);
  const Candidate a = turned(0.0, 0.01);
  EXPECT_LE(turns_disagreement(a, turned(limit - 1e-9, 0.02), tolerances, false), 1.0);
  EXPECT_GT(turns_disagreement(a, turned(limit + 1e-6, 0.02), tolerances, false), 1.0);
  EXPECT_GT(turns_disagreement(a, turned(0.05 + 1e-6, 0.02), tolerances, true), 1.0);
}

// One corner and one wall each; the sensed ones moved against each other.
double corner_line(double across, double along, const MatchingOptions& options,
                   double corner_variance = 0.0) {
  FeatureList sensed;
  sensed.corners = {corner_at(3.0 + across, 1.0 + along)};
  sensed.corners[0].covariance = corner_variance * Matrix2d::Identity();
  sensed.lines = {wall(0.0, 5.0, -1.0, 1.0)};
  FeatureList model;
  model.corners = {corner_at(3.0, 1.0)};
  model.lines = {wall(0.0, 5.0, -1.0, 1.0)};
  const Pairs pairs(sensed, model, options);
  if (pairs.candidates.pairs.size() != 2) return -1.0;
  const bool corner_first = pairs.candidates.pairs[0].kind == FeatureKind::corner;
  const TernaryTolerances tolerances = ternary_tolerances(options);
  return corner_line_disagreement(
      relate(pairs.sensed.corners[0], pairs.sensed.lines[0], tolerances),
      relate(pairs.model.corners[0], pairs.model.lines[0]),
      pairs.candidates.pairs[corner_first ? 0 : 1], pairs.candidates.pairs[corner_first ? 1 : 0],
      pairs.sensed.lines[0], tolerances);
}

TEST(CornerLine, PaperComparesTheSignedDistance) {
  EXPECT_GE(corner_line(0.5 - 1e-9, 0.0, paper()), 0.0);
  EXPECT_LE(corner_line(0.5 - 1e-9, 0.0, paper()), 1.0);
  EXPECT_GT(corner_line(0.5 + 1e-6, 0.0, paper()), 1.0);
  EXPECT_GT(corner_line(-0.5 - 1e-6, 0.0, paper()), 1.0);
}

TEST(CornerLine, TheOtherSideOfTheWallIsNotTheSame) {
  const MatchingOptions options = paper();
  const Corner near = corner_at(4.4, 0.0);
  const Corner far = corner_at(5.6, 0.0);
  const Line between = wall(0.0, 5.0, -1.0, 1.0);
  const CornerView inside = view_of(near, options);
  const CornerView outside = view_of(far, options);
  const LineView line = view_of(between, options);
  EXPECT_GT(corner_line_disagreement(relate(inside, line), relate(outside, line), {}, {}, line,
                                     ternary_tolerances(options)),
            1.0);
}

TEST(CornerLine, CliqueAddsNoiseInQuadrature) {
  EXPECT_LE(corner_line(0.2 - 1e-9, 0.0, clique()), 1.0);
  EXPECT_GT(corner_line(0.2 + 1e-6, 0.0, clique()), 1.0);
  const double limit = std::hypot(0.2, 0.3);
  EXPECT_LE(corner_line(limit - 1e-9, 0.0, clique(), 0.01), 1.0);
  EXPECT_GT(corner_line(limit + 1e-6, 0.0, clique(), 0.01), 1.0);
}

TEST(CornerLine, CliqueAsksTheSlideToKeepTheOverlap) {
  // Walls of 2 m that must overlap by 1 m let the corner slide by 1 m and the tolerance.
  MatchingOptions options = clique();
  options.poserr = 3.0;
  EXPECT_LE(corner_line(0.0, 1.2 - 1e-9, options), 1.0);
  EXPECT_GT(corner_line(0.0, 1.2 + 1e-6, options), 1.0);
}

// Two walls; the sensed ones at the given orientations and distances.
double lines(const Line& sensed_a, const Line& sensed_b, const Line& model_a, const Line& model_b,
             const MatchingOptions& options) {
  const LineView sa = view_of(sensed_a, options);
  const LineView sb = view_of(sensed_b, options);
  const LineView ma = view_of(model_a, options);
  const LineView mb = view_of(model_b, options);
  FeatureViews sensed;
  FeatureViews model;
  const FeatureList empty;
  sensed.features = model.features = &empty;
  const auto pair = [&](const LineView& s, const LineView& m) {
    sensed.lines = {s};
    model.lines = {m};
    sensed.order = model.order = {{FeatureKind::line, 0, 0.0}};
    CandidateList list;
    find_candidates(sensed, model, options, list);
    return list.pairs.empty() ? Candidate{} : list.pairs[0];
  };
  const Candidate a = pair(sa, ma);
  const Candidate b = pair(sb, mb);
  EXPECT_TRUE(a.has_turn && b.has_turn) << "the unary constraints reject a pair";
  return lines_disagreement(a, sa, ma, b, sb, mb, ternary_tolerances(options), false);
}

TEST(Lines, OfACorridorKeepItsWidth) {
  const MatchingOptions options = clique();
  const Line left = wall(0.5 * kPi, 3.0, -5.0, 5.0);
  const Line right = wall(-0.5 * kPi, 3.0, -5.0, 5.0);
  const auto with = [&](double to_left, double to_right) {
    return lines(wall(0.5 * kPi, to_left, -5.0, 5.0), wall(-0.5 * kPi, to_right, -5.0, 5.0), left,
                 right, options);
  };
  EXPECT_LE(with(3.4, 2.6), 1.0) << "a step to the right";
  EXPECT_LE(with(3.1, 3.1 - 1e-9), 1.0);
  EXPECT_GT(with(3.1, 3.1 + 1e-6), 1.0) << "a corridor 0.2 m wider";
}

TEST(Lines, ThatFaceOneWayKeepTheirOffset) {
  MatchingOptions options = clique();
  options.min_overlap = 0.0;
  const Line near = wall(0.0, 3.0, -5.0, -0.1);
  const Line far = wall(0.0, 3.4, 0.1, 5.0);
  EXPECT_LE(lines(near, far, near, far, options), 1.0);
  EXPECT_GT(lines(near, far, far, near, options), 1.0);
}

TEST(Lines, MustOverlapAfterTheMoveThatTheOtherShows) {
  MatchingOptions options = clique();
  options.poserr = 3.0;
  const Line end = wall(0.0, 6.0, -3.0, 3.0);
  const Line side = wall(0.5 * kPi, 3.0, -2.0, 2.0);
  const auto stepped = [&](double forward) {
    // The end wall says that the observer went `forward`; the side wall was not passed by.
    return lines(wall(0.0, 6.0 - forward, -3.0, 3.0), side, end, side, options);
  };
  EXPECT_LE(stepped(1.9), 1.0);
  EXPECT_GT(stepped(2.3), 1.0);
}

TEST(Collinear, WithinThePlainTolerances) {
  const TernaryTolerances tolerances = ternary_tolerances(clique());
  const MatchingOptions options = clique();
  const Line first = wall(0.0, 3.0, -2.0, 0.0);
  const LineView a = view_of(first, options);
  EXPECT_TRUE(are_collinear(a, view_of(wall(0.0, 3.19, 1.0, 2.0), options), tolerances));
  EXPECT_FALSE(are_collinear(a, view_of(wall(0.0, 3.21, 1.0, 2.0), options), tolerances));
  EXPECT_FALSE(are_collinear(a, view_of(wall(0.06, 3.0, 1.0, 2.0), options), tolerances));
}

TEST(OneCorner, ShowsComplementaryArmsAtOnePlace) {
  const MatchingOptions options = clique();
  const TernaryTolerances tolerances = ternary_tolerances(options);
  Corner a = corner_at(3.0, 0.0);
  Corner b = corner_at(3.0, 0.19);
  a.arms = {0, -1};
  b.arms = {-1, 1};
  EXPECT_TRUE(are_one_corner(view_of(a, options), view_of(b, options), tolerances));
  b.position.y() = 0.21;
  EXPECT_FALSE(are_one_corner(view_of(a, options), view_of(b, options), tolerances));
  b = a;
  EXPECT_FALSE(are_one_corner(view_of(a, options), view_of(b, options), tolerances));
}

}  // namespace
}  // namespace adit
