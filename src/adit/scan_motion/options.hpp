#pragma once

namespace adit {

/// How scans become points of walls.
struct SurfaceOptions {
  int most_points = 360;
  double spacing_m = 0.03;
  double least_reach_m = 0.12;
  double reach_spacings = 2.5;
  double reach_sigmas = 6.0;
  double flat_sigmas = 3.0;
  double roughness_m = 0.02;
  double grazing_rad = 0.12;

  template <class Self, class Field>
  static void visit(Self& self, Field&& field) {
    field("most_points", self.most_points, "of a scan with more returns every so manieth is taken");
    field("spacing_m", self.spacing_m,
          "of points on one wall that lie nearer than this one is taken (m)");
    field("least_reach_m", self.least_reach_m,
          "a point's normal is that of its neighbours up to this far (m) ...");
    field("reach_spacings", self.reach_spacings, "... or so many times as far as the next one ...");
    field("reach_sigmas", self.reach_sigmas, "... or so many sigmas of the beam");
    field("flat_sigmas", self.flat_sigmas,
          "neighbours that lie about their line by more than so many sigmas show no normal");
    field("roughness_m", self.roughness_m,
          "how far walls lie about a straight line over that reach, one sigma (m)");
    field("grazing_rad", self.grazing_rad,
          "neighbours belong together down to this angle between beam and wall (rad)");
  }
};

/// How points of walls are laid onto others.
struct AlignmentOptions {
  int max_iterations = 12;
  double first_reach_m = 0.3;
  double last_reach_m = 0.12;
  double scale_m = 0.03;
  double wall_sigma_m = 0.02;
  double shared_error_points = 5.0;
  double slides_ratio = 0.01;
  double holds_ratio = 0.03;

  template <class Self, class Field>
  static void visit(Self& self, Field&& field) {
    field("max_iterations", self.max_iterations, "steps of one alignment, at most");
    field("first_reach_m", self.first_reach_m,
          "at first points belong to walls no farther than this (m) ...");
    field("last_reach_m", self.last_reach_m, "... at last no farther than this (m)");
    field("scale_m", self.scale_m,
          "points farther from their wall than this weigh less than half (m)");
    field("wall_sigma_m", self.wall_sigma_m,
          "how far walls lie from where other scans saw them, beside the noise of beams, one sigma "
          "(m)");
    field("shared_error_points", self.shared_error_points,
          "so many points err alike: together they tell as much as one alone");
    field("slides_ratio", self.slides_ratio,
          "walls that hold a pose in its weakest direction to no more than this part of the "
          "strongest do not hold it there: the noise of their normals does as much ...");
    field("holds_ratio", self.holds_ratio, "... and from this part on they do");
  }
};

/// The grid in which places are compared.
struct FieldOptions {
  double cell_m = 0.1;
  double blur_m = 0.1;
  double unseen = 0.3;
  double most_reach_m = 30.0;

  template <class Self, class Field>
  static void visit(Self& self, Field&& field) {
    field("cell_m", self.cell_m, "cells of the grid in which places are compared (m)");
    field("blur_m", self.blur_m, "how far off a wall a point still goes with it, one sigma (m)");
    field("unseen", self.unseen, "what a point where nothing was seen is worth; 1 is a wall");
    field("most_reach_m", self.most_reach_m,
          "points farther than this from the middle are left out (m)");
  }
};

/// How a scan is laid onto the last few.
struct ScanMotionOptions {
  double keyframe_m = 0.35;
  double keyframe_rad = 0.30;
  int local_keyframes = 14;
  double search_m = 0.2;
  double search_rad = 0.2;
  double search_sigmas = 3.0;
  double odometry_doubt = 4.0;
  double slip_m = 0.01;
  double slip_rad = 0.005;
  double most_odometry_score = 0.15;
  double most_search_m = 1.5;
  double most_search_rad = 0.7;
  double good_score = 0.55;
  double better_share = 0.15;
  double surprising_sigmas = 6.0;
  double surprising_share = 0.75;
  int surprising_matched = 60;
  double least_share = 0.35;
  int least_matched = 15;

  template <class Self, class Field>
  static void visit(Self& self, Field&& field) {
    field("keyframe_m", self.keyframe_m,
          "a scan is kept for the next ones after a move of this (m) ...");
    field("keyframe_rad", self.keyframe_rad, "... or a turn of this (rad)");
    field("local_keyframes", self.local_keyframes, "scans are laid onto so many kept ones");
    field("search_m", self.search_m, "a scan is looked for around dead reckoning this far (m) ...");
    field("search_rad", self.search_rad, "... and turned by this (rad) ...");
    field("search_sigmas", self.search_sigmas, "... or so many sigmas of dead reckoning, if more");
    field("odometry_doubt", self.odometry_doubt,
          "in the alignment dead reckoning is taken to be so many times worse than stated: what "
          "scans tell, they shall tell alone");
    field("slip_m", self.slip_m,
          "a machine may move so far between two scans and not report it, one sigma (m) ...");
    field("slip_rad", self.slip_rad, "... and turn (rad)");
    field("most_search_m", self.most_search_m,
          "where nothing fits it is looked for again, as far as this (m) ...");
    field("most_search_rad", self.most_search_rad, "... and turned by this (rad)");
    field("most_odometry_score", self.most_odometry_score,
          "... where to go with dead reckoning counts no more than this mean part of points that "
          "hit walls");
    field("good_score", self.good_score, "a scan fits whose points hit walls to this mean part");
    field("better_share", self.better_share,
          "found farther off it must find walls for so much more of its points");
    field("surprising_sigmas", self.surprising_sigmas,
          "where dead reckoning would be wrong by more than so many sigmas ...");
    field("surprising_share", self.surprising_share,
          "... this share of the points must find walls ...");
    field("surprising_matched", self.surprising_matched,
          "... and so many of them; and they must go worse with the walls, by the share above, "
          "where dead reckoning is right");
    field("least_share", self.least_share,
          "a scan of whose points a smaller share finds walls is placed by dead reckoning");
    field("least_matched", self.least_matched, "and one of whose points fewer find walls");
  }
};

}  // namespace adit
