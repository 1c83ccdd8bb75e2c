#pragma once

#include "adit/geometry/pose2.hpp"

namespace adit {

/// When is a set of pairs consistent?
enum class Consistency {
  clique,  ///< every pair agrees with every other
  paper,   ///< each pair agrees with the two pairs before it in the (cyclic) order
};

/// Tolerances of the matcher: the paper's under its names (section III-F, values of section IV-E),
/// and those of the clique definition, which knows the noise of each sensed feature.
///
/// `paper` uses the paper's six exactly. `clique` takes `angerr`, `poserr` and `concerr` too, adds
/// what noise and plan may err, and replaces the fixed `disterr`, `terndisterr` and `ternangerr` by
/// the root of the squares of `map_disterr` (or `map_angerr`) and `noise_sigmas` sigma. Of a
/// corner's noise, which can be endless along a wall, no more than `terndisterr` counts.
struct MatchingOptions {
  Consistency consistency = Consistency::clique;
  double angerr = 0.0872664625997165;  // 5 degrees
  double poserr = 1.0;
  double concerr = 0.174532925199433;  // 10 degrees
  double disterr = 0.5;
  double terndisterr = 0.5;
  double ternangerr = 0.0872664625997165;  // 5 degrees
  double noise_sigmas = 3.0;
  double map_disterr = 0.1;
  double map_angerr = 0.0349065850398866;  // 2 degrees
  double min_overlap = 0.5;
  double prior_sigmas = 4.0;
  double min_poserr = 0.4;
  double max_poserr = 3.0;
  double min_angerr = 0.0698131700797732;  // 4 degrees
  double max_angerr = 0.523598775598299;   // 30 degrees
  int max_candidates = 1500;
  int max_calls = 20000;

  template <class Self, class Field>
  static void visit(Self& self, Field&& field) {
    field(
        "angerr", self.angerr,
        "paper: largest heading error of the predicted pose (rad); clique takes it from the prior");
    field(
        "poserr", self.poserr,
        "paper: largest position error of the predicted pose (m); clique takes it from the prior");
    field("concerr", self.concerr, "tolerance of a corner's concave angle (rad)");
    field("disterr", self.disterr, "paper: tolerance of a line's perpendicular distance (m)");
    field("terndisterr", self.terndisterr,
          "paper: tolerance of distances between pairs; clique: the most that a corner's noise may "
          "excuse (m)");
    field("ternangerr", self.ternangerr, "paper: tolerance of angles between pairs (rad)");
    field("noise_sigmas", self.noise_sigmas,
          "clique: sensed features may err by this many sigmas of their covariance");
    field("map_disterr", self.map_disterr,
          "clique: what the plan may err in a distance between two features (m); 3 sigma of two "
          "walls that are good to 2.4 cm");
    field("map_angerr", self.map_angerr,
          "clique: what the plan may err in an angle between two features (rad)");
    field("min_overlap", self.min_overlap,
          "clique: a sensed and a model line overlap by this share of the shorter one");
    field("prior_sigmas", self.prior_sigmas,
          "clique: poserr and angerr are this many sigmas of the predicted pose; 4 fails once in "
          "16,000");
    field("min_poserr", self.min_poserr, "poserr from a prior is at least this (m)");
    field("max_poserr", self.max_poserr, "poserr from a prior is at most this (m)");
    field("min_angerr", self.min_angerr, "angerr from a prior is at least this (rad)");
    field("max_angerr", self.max_angerr, "angerr from a prior is at most this (rad)");
    field("max_candidates", self.max_candidates,
          "of more candidate pairs than this, those of the features with the most points are kept");
    field("max_calls", self.max_calls,
          "calls of the search after which the best set so far is taken");
  }
};

/// The options with `poserr` and `angerr` taken from the covariance of the predicted scanner pose
/// over (x, y, theta) (m, m, rad): `prior_sigmas` of the worst direction and of the heading, within
/// the floors and caps. A covariance that is not finite gives the caps. In `paper` mode the options
/// come back as they are.
MatchingOptions tolerances_from_prior(const MatchingOptions& base,
                                      const Matrix3d& covariance_of_predicted_scanner_pose);

}  // namespace adit
