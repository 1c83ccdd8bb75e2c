#pragma once

#include "adit/geometry/angle.hpp"

namespace adit {

/// How walls are told from the rest, merged and simplified.
struct WallOptions {
  double cell_m = 0.05;
  double merge_m = 0.06;
  double smooth_m = 0.12;
  double pose_sigma_m = 0.02;
  double pose_sigma_rad = radians(0.2);
  double tolerance_m = 0.05;
  double gap_m = 1.0;
  double corner_gap_m = 0.3;
  double min_length_m = 0.5;
  double max_incidence_rad = radians(87.0);
  double visit_m = 2.0;
  double seen_through_m = 0.15;
  double occupied_share = 0.5;
  double min_hits_per_m = 10.0;
  int min_scans = 3;
  double sure_range_m = 1e9;
  int min_far_visits = 2;
  int min_far_scans = 3;

  template <class Self, class Field>
  static void visit(Self& self, Field&& field) {
    field("cell_m", self.cell_m, "cells in which the ends of beams are gathered (m)");
    field(
        "merge_m", self.merge_m,
        "layers about this far apart are one wall seen from poses that err, one sigma; grows with "
        "the scanner's noise (m)");
    field("smooth_m", self.smooth_m,
          "walls are averaged along themselves over about this, one sigma (m)");
    field("pose_sigma_m", self.pose_sigma_m,
          "error of a pose that its covariance does not tell, one sigma (m)");
    field("pose_sigma_rad", self.pose_sigma_rad, "the same of its heading (rad)");
    field("tolerance_m", self.tolerance_m,
          "segments follow the wall that was seen to within this (m)");
    field("gap_m", self.gap_m,
          "wider gaps of a wall stay open; narrower ones are closed unless beams went through (m)");
    field("corner_gap_m", self.corner_gap_m, "two walls whose ends are nearer than this meet (m)");
    field("min_length_m", self.min_length_m,
          "walls of less extent that stand alone are dropped (m)");
    field("max_incidence_rad", self.max_incidence_rad,
          "beams that meet a wall flatter than this, from its normal, say nothing of it (rad)");
    field("visit_m", self.visit_m,
          "after so much way what is seen counts as seen on another visit (m)");
    field("seen_through_m", self.seen_through_m,
          "a beam that ends farther than this behind a wall went through it; at least three sigma "
          "of the scanner (m)");
    field("occupied_share", self.occupied_share,
          "what fewer visits than this share found in place is no wall: it moves");
    field("min_hits_per_m", self.min_hits_per_m, "walls with fewer hits on a metre are dropped");
    field("sure_range_m", self.sure_range_m,
          "what is met from farther than this only may be roof or floor (m) ...");
    field("min_far_visits", self.min_far_visits,
          "... and is a wall where so many visits met it in one place ...");
    field("min_far_scans", self.min_far_scans, "... or so many scans");
    field("min_scans", self.min_scans, "places of a wall that fewer scans met are dropped");
  }
};

}  // namespace adit
