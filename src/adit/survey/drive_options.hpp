#pragma once

#include "adit/scan_motion/options.hpp"

namespace adit {

/// How a drive is followed from scan to scan.
struct TrackingStepOptions {
  double step_m = 0.02;
  double step_rad = 0.01;
  int most_skipped = 1;
  ScanMotionOptions motion;

  template <class Self, class Field>
  static void visit(Self& self, Field&& field) {
    field("step_m", self.step_m, "a scan is laid onto the last ones after a move of this (m) ...");
    field("step_rad", self.step_rad, "... or a turn of this (rad) ...");
    field("most_skipped", self.most_skipped,
          "... and where dead reckoning reports none, after so many scans");
    ScanMotionOptions::visit(self.motion, field);
  }
};

/// Where and how places that were seen before are looked for.
struct LoopOptions {
  FieldOptions grid;
  int query_keyframes = 5;
  int query_stride = 3;
  int target_keyframes = 13;
  int target_stride = 6;
  int least_apart = 25;
  int most_targets = 5;
  double sight_m = 6.0;
  double first_limit_m = 0.5;
  double last_limit_m = 8.0;
  double window_sigmas = 3.0;
  double least_score = 0.6;
  double rival_margin = 0.07;
  double rival_m = 1.0;
  double rival_rad = 0.4;
  double surroundings_m = 40.0;
  double likeness_margin = 0.1;
  double least_hits = 0.45;
  double most_contradiction = 0.2;
  double least_stiffness = 0.03;
  int least_support = 2;
  double support_m = 0.3;
  double consistent_chi_square = 11.3;
  double closure_sigma_m = 0.04;
  double closure_sigma_rad = 0.008;

  template <class Self, class Field>
  static void visit(Self& self, Field&& field) {
    FieldOptions::visit(self.grid, field);
    field("query_keyframes", self.query_keyframes, "so many kept scans are looked for together");
    field("query_stride", self.query_stride, "around every so manieth");
    field("target_keyframes", self.target_keyframes, "among so many others together");
    field("target_stride", self.target_stride, "around every so manieth");
    field("least_apart", self.least_apart, "that were kept so many before, at least");
    field("most_targets", self.most_targets, "at so many places, at most");
    field("sight_m", self.sight_m, "two places may show the same walls up to this far apart (m)");
    field("first_limit_m", self.first_limit_m,
          "first where the drift since is no more than this, one sigma (m)");
    field("last_limit_m", self.last_limit_m, "then twice that, up to this (m)");
    field("window_sigmas", self.window_sigmas, "so many sigmas of the drift around");
    field("least_score", self.least_score, "points hit walls to this mean part, at least");
    field("rival_margin", self.rival_margin,
          "and by so much more than anywhere else within the window, ...");
    field("rival_m", self.rival_m, "... where elsewhere is this far off (m) ...");
    field("rival_rad", self.rival_rad, "... or turned by this (rad)");
    field("surroundings_m", self.surroundings_m,
          "the way before and after a place on which its likeness is looked for (m)");
    field("likeness_margin", self.likeness_margin,
          "and as far off as the window is wide, points must hit walls less by so much");
    field("least_hits", self.least_hits, "this share of the points must hit walls");
    field("most_contradiction", self.most_contradiction,
          "of the points where beams had been, no more than this share where they had passed");
    field("least_stiffness", self.least_stiffness,
          "walls must hold the pose in its weakest direction to this part of the strongest");
    field("least_support", self.least_support,
          "a place is believed to be another seen before only if so many others agree with it");
    field("support_m", self.support_m,
          "who agrees must have been taken so near in time that drift between them is less (m)");
    field("consistent_chi_square", self.consistent_chi_square,
          "two agree up to this error (three degrees of freedom, 99 %)");
    field("closure_sigma_m", self.closure_sigma_m,
          "how far off such a place may be, one sigma (m)");
    field("closure_sigma_rad", self.closure_sigma_rad, "and its heading (rad)");
  }
};

/// How all scans are laid onto each other at the end.
struct JointOptions {
  int rounds = 4;
  int neighbours = 16;
  int in_time = 4;
  int most_pairs = 60000;
  int most_looks = 400;
  int most_reached = 4000;
  double sight_m = 8.0;
  double least_share = 0.4;
  double believed_sigma_m = 0.2;
  double reach_m = 0.2;
  double anchor_sigma_m = 0.05;
  double anchor_sigma_rad = 0.02;
  double pair_sigma_m = 0.015;
  double pair_sigma_rad = 0.004;
  double robust_sigmas = 2.0;

  template <class Self, class Field>
  static void visit(Self& self, Field&& field) {
    field("rounds", self.rounds, "how often all scans are laid onto each other and solved for");
    field("neighbours", self.neighbours, "a scan is laid onto so many others, at most, ...");
    field("in_time", self.in_time, "... so many of them the ones before it, ...");
    field("most_pairs", self.most_pairs,
          "of long drives each onto fewer, so that there are no more pairs than this in all, but "
          "two a scan at least");
    field(
        "most_looks", self.most_looks,
        "where a place was passed very often, a scan is held against no more others than this ...");
    field("most_reached", self.most_reached,
          "... that are among so many whose drift against it is known best");
    field("sight_m", self.sight_m, "... taken no farther from it than this (m)");
    field("least_share", self.least_share, "that show at least this share of its points");
    field("believed_sigma_m", self.believed_sigma_m,
          "against which its pose is known better than this, one sigma (m)");
    field("reach_m", self.reach_m, "points belong to walls no farther than this (m)");
    field("anchor_sigma_m", self.anchor_sigma_m,
          "a pair is moved by no more than this where walls leave it free, one sigma (m)");
    field("anchor_sigma_rad", self.anchor_sigma_rad, "and turned (rad)");
    field("pair_sigma_m", self.pair_sigma_m,
          "how well two scans tell each other's place at best, one sigma (m)");
    field("pair_sigma_rad", self.pair_sigma_rad, "and heading (rad)");
    field("robust_sigmas", self.robust_sigmas, "pairs that disagree by more than this pull less");
  }
};

/// How a drive is brought into the frame of a plan.
struct KnownPlacesOptions {
  double apart_m = 3.0;
  double robust_sigmas = 2.0;
  double plan_sigma_m = 0.05;

  template <class Self, class Field>
  static void visit(Self& self, Field&& field) {
    field("apart_m", self.apart_m,
          "known places nearer to each other on the way than this err alike: together they tell as "
          "much as one alone (m)");
    field("robust_sigmas", self.robust_sigmas,
          "known places that the drive contradicts by more than this pull less");
    field("plan_sigma_m", self.plan_sigma_m,
          "how far a known place may be off beside what it states, one sigma (m)");
  }
};

/// All that a survey of a drive can be told.
struct DriveSurveyOptions {
  SurfaceOptions surface;
  AlignmentOptions alignment;
  TrackingStepOptions tracking;
  LoopOptions loops;
  JointOptions joint;
  KnownPlacesOptions known_places;
};

}  // namespace adit
