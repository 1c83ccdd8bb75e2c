#pragma once

#include <algorithm>
#include <limits>

#include "adit/extraction/extraction.hpp"
#include "adit/geometry/angle.hpp"
#include "adit/places/corner_index.hpp"

namespace adit {

/// The likelihood of a scan from a pose that nothing but the scan speaks for.
struct LikelihoodOptions {
  int beams = 120;
  double trust = 0.2;
  double trust_most = 0.4;
  double trusted_error_ratio = 0.25;

  template <class Self, class Field>
  static void visit(Self& self, Field&& field) {
    field("beams", self.beams, "so many beams of a scan are looked at");
    field("trust", self.trust,
          "what counts of a log likelihood: what stands before the walls, and how they differ from "
          "the plan, is shared by more beams than the model knows ...");
    field(
        "trusted_error_ratio", self.trusted_error_ratio,
        "... in proportion more where the plan errs by less than this part of what is stated: the "
        "less it does, the less is shared ...");
    field("trust_most", self.trust_most, "... but no more than this");
  }
};

/// How the corners of a scan are taken for those of a plan.
struct CornerSearchOptions {
  ExtractionOptions extraction;
  CornerLimits limits{1.0, 0.35, 8.0};  ///< of the scan's: walls are seen in part
  double tolerance_rad = 0.2;
  double gap_slack_m = 1.0;
  int fewest = 2;
  int most = 12;
  double most_pairs = 2.0e6;
  int returns = 16;
  double rated_share = 0.15;
  int fewest_rated = 20000;
  double sigma_m = 0.4;
  double cell_m = 0.6;
  double cell_rad = 0.1;

  template <class Self, class Field>
  static void visit(Self& self, Field&& field) {
    field("corner_tolerance_rad", self.tolerance_rad,
          "a corner of the plan opens as wide as one of the scan within this (rad)");
    field("corner_gap_slack_m", self.gap_slack_m,
          "its walls end farther from where they meet by no more than this (m): what hides them "
          "makes "
          "those of the scan shorter");
    field("corner_fewest", self.fewest,
          "so many corners of the scan are tried in a plan of any size");
    field("corner_most", self.most,
          "and no more than so many, those of the longest walls first ...");
    field("corner_most_pairs", self.most_pairs,
          "... while no more pairs of corners than this come of it");
    field("corner_returns", self.returns, "so many returns rate each pair ...");
    field("corner_sigma_m", self.sigma_m,
          "... by how near they are to walls, one sigma (m), first roughly ...");
    field("corner_rated_share", self.rated_share, "... and this share of all pairs again");
    field("corner_fewest_rated", self.fewest_rated, "but not fewer than this");
    field("corner_cell_m", self.cell_m, "poses in one square of this side are one (m) ...");
    field("corner_cell_rad", self.cell_rad, "... if in one sector of this width (rad)");
  }
};

/// How a scan is searched for in a plan, and when the answer may be trusted.
struct RelocationOptions {
  double shorter_cap = 5.0;
  double longer_cap = 14.0;
  int first_bins = 16;
  double rated_share = 0.1;
  int fewest_rated = 8000;
  double compared_share = 0.01;
  int compared = 2500;
  double moved_share = 0.01;
  int moved = 1500;
  double moved_again_share = 0.002;
  int moved_again = 300;
  CornerSearchOptions corners;
  double corners_moved_share = 0.02;
  int corners_moved = 1000;
  double corners_moved_again_share = 0.002;
  int corners_moved_again = 150;
  double agreement_per_through = 1.0;
  int first_beams = 30;
  int quick_beams = 100;
  double slack_ratio = 0.3;
  int fewest_candidates = 30;
  int candidates = 250;
  double agreement_per_step = 0.07;
  double score_slack = 0.1;
  int rated_again = 100;
  int fitted_again = 40;
  int refined = 20;
  int listed = 20;
  double doubt_rad = 0.015;
  double start_m = 0.2;
  double same_place_m = 0.15;
  double basin_m = 1.0;
  double basin_rad = 0.1;
  double merge_m = 0.8;
  double merge_rad = radians(3.0);
  double unfitted_gap = 50.0;
  double hopeless_gap = 200.0;
  double least_map_ratio = 0.1;
  double least_weight = 1e-4;
  double rival_weight = 0.02;
  double apart_m = 1.0;
  double apart_rad = radians(5.0);
  double second_look_gap = 40.0;
  double sure_gap = 1.5;
  double sure_gap_per_through = 100.0;
  double sure_gap_per_missing = 20.0;
  double sure_gap_per_behind = 60.0;
  double sure_gap_per_line = 1.0;
  int enough_lines = 7;
  double line_m = 1.0;
  double sure_gap_per_error = 8.0;
  double sure_gap_per_evidence = 200.0;

  template <class Self, class Field>
  static void visit(Self& self, Field&& field) {
    visit_search(self, field);
    visit_fits(self, field);
  }

 private:
  template <class Self, class Field>
  static void visit_search(Self& self, Field& field) {
    field("shorter_cap", self.shorter_cap,
          "most that a bearing speaks against a heading of a place where the scan is shorter than "
          "the plan: something may stand there (steps of the range code, at most 15)");
    field("longer_cap", self.longer_cap, "and where it is longer: it went through rock");
    field("first_bins", self.first_bins,
          "so many bearings choose the places at which all are tried (at most 16)");
    field("rated_share", self.rated_share,
          "this share of all places, by their ranges without regard to heading, is rated at all "
          "headings");
    field("fewest_rated", self.fewest_rated, "but not fewer than this");
    field("compared_share", self.compared_share,
          "so many of them, a share of all places, are compared with the scan in all bearings");
    field("compared", self.compared, "but not fewer than this");
    field("slack_ratio", self.slack_ratio,
          "walls may be nearer or farther from a place of the index by this part of its pitch");
    CornerSearchOptions::visit(self.corners, field);
    field("agreement_per_through", self.agreement_per_through,
          "a return from behind a wall outweighs so many that lie at walls");
    field("moved_share", self.moved_share,
          "so many poses of those, a share likewise, are moved onto the walls nearest to the scan: "
          "a larger plan has more places that are alike");
    field("moved", self.moved, "but not fewer than this");
    field("moved_again_share", self.moved_again_share, "and the best of these moved on");
    field("moved_again", self.moved_again, "but not fewer than this");
    field(
        "corners_moved_share", self.corners_moved_share,
        "so many poses that corners speak for, a share of the plan's corners, are moved likewise");
    field("corners_moved", self.corners_moved, "but not fewer than this");
    field("corners_moved_again_share", self.corners_moved_again_share,
          "and the best of these moved on");
    field("corners_moved_again", self.corners_moved_again, "but not fewer than this");
    field("first_beams", self.first_beams, "first with so many beams");
    field("quick_beams", self.quick_beams, "then with so many");
    field("fewest_candidates", self.fewest_candidates,
          "so many of those are fitted with some of the beams ...");
    field("candidates", self.candidates, "... and up to so many ...");
    field("score_slack", self.score_slack,
          "... that are no worse than the best by this: share of the returns that agree");
    field("agreement_per_step", self.agreement_per_step,
          "so much agreement makes up for one step of the range code, the bearings' mean, before "
          "poses are moved on");
  }

  template <class Self, class Field>
  static void visit_fits(Self& self, Field& field) {
    field("rated_again", self.rated_again,
          "of so many fits the likelihood is looked at, each with the error of the plan that suits "
          "it best");
    field("fitted_again", self.fitted_again, "so many of those are fitted once more");
    field("refined", self.refined, "and so many of those with all points");
    field("listed", self.listed, "no more poses than this are given as answers");
    field("start_m", self.start_m, "how far off a pose from the search is, one sigma (m)");
    field("doubt_rad", self.doubt_rad, "the same for its heading (rad)");
    field("same_place_m", self.same_place_m,
          "a fit with some of the beams works out what the map shows anew after steps of so much "
          "(m)");
    field("basin_m", self.basin_m,
          "what the scan leaves open is no wider than this, one sigma (m)");
    field("basin_rad", self.basin_rad, "the same for the heading (rad)");
    field("merge_m", self.merge_m, "fits no farther apart than this are one pose (m) ...");
    field("merge_rad", self.merge_rad, "... if no more turned than this (rad)");
    field("unfitted_gap", self.unfitted_gap,
          "a pose less likely than the best by more than this (log, all of it) is not fitted "
          "further, "
          "but for the best few");
    field("hopeless_gap", self.hopeless_gap,
          "how much less likely than the best others are (log) counts no further than to this");
    field("least_map_ratio", self.least_map_ratio,
          "the plan may be better than stated, down to this part of the stated error: how much the "
          "scan itself says");
    field("least_weight", self.least_weight, "poses of less weight are not listed");
    field("rival_weight", self.rival_weight,
          "the best pose stands alone where all others together weigh less than this");
    field("apart_m", self.apart_m, "another pose is one farther than this (m) ...");
    field("apart_rad", self.apart_rad, "... or turned by more than this (rad)");
    field("second_look_gap", self.second_look_gap,
          "after the first look a pose is sure only where no other comes nearer to it than this "
          "(log); else a second one decides, with more fits and, in a small plan, at twice as many "
          "places; 0 for none");
    field("sure_gap", self.sure_gap,
          "a pose is sure only where every other one is less likely by this (log), for a scan that "
          "sees all around; one that sees part of a turn agrees with more places by chance, and is "
          "asked for as much over that part to the power of 2.5 ...");
    field(
        "sure_gap_per_through", self.sure_gap_per_through,
        "... and by so much more per share of the returns that come from behind the map's walls or "
        "from where it has none ...");
    field("sure_gap_per_behind", self.sure_gap_per_behind,
          "... per share of them that the fit takes for such, near edges as well ...");
    field("sure_gap_per_missing", self.sure_gap_per_missing,
          "... per share of the beams that should have met a wall and brought no return ...");
    field("sure_gap_per_line", self.sure_gap_per_line, "... per line that the scan has fewer ...");
    field("enough_lines", self.enough_lines, "... than this many ...");
    field("line_m", self.line_m,
          "... of so many metres at least: any mine has a drift with an end like it ...");
    field("sure_gap_per_error", self.sure_gap_per_error,
          "... where the plan errs as much as stated, for a larger error lets more poses agree by "
          "chance ...");
    field(
        "sure_gap_per_evidence", self.sure_gap_per_evidence,
        "... and for the square of the share by which less is explained than of a scan of nothing "
        "but the map's walls");
  }
};

/// With more of all that thins out the search, for a second look: twice as many places, but where
/// a large plan has that many already.
inline RelocationOptions widened(RelocationOptions options) {
  const auto multiply = [](int& count, int times) {
    count = std::min(count, std::numeric_limits<int>::max() / times) * times;
  };
  for (int* count : {&options.fewest_rated, &options.compared, &options.moved, &options.moved_again,
                     &options.corners_moved, &options.corners_moved_again,
                     &options.fewest_candidates, &options.candidates}) {
    multiply(*count, 2);
  }
  for (int* count : {&options.rated_again, &options.fitted_again, &options.refined}) {
    multiply(*count, 3);
  }
  options.score_slack *= 2.0;
  options.unfitted_gap *= 3.0;
  return options;
}

}  // namespace adit
