#pragma once

#include <vector>

#include "adit/deskew/deskewer.hpp"
#include "adit/deskew/sweep_motion.hpp"
#include "adit/estimation/estimation.hpp"
#include "adit/extraction/extraction.hpp"
#include "adit/matching/matching.hpp"
#include "adit/motion/odometry.hpp"
#include "adit/prediction/prediction.hpp"
#include "adit/recovery/hypotheses.hpp"
#include "adit/recovery/place_finder.hpp"
#include "adit/recovery/search_schedule.hpp"
#include "adit/refinement/displacement.hpp"
#include "adit/refinement/map_error.hpp"
#include "adit/refinement/options.hpp"
#include "adit/refinement/pose_search.hpp"
#include "adit/scan/laser_scan.hpp"
#include "adit/scan/scanner_model.hpp"
#include "adit/tracking/pose_tracker.hpp"
#include "adit/tracking/protection.hpp"
#include "adit/tracking/stamp_watch.hpp"
#include "adit/tracking/verdict.hpp"

namespace adit {

/// What is believed before the first estimate and between two.
struct LocalizerOptions {
  double start_sigma_m = 0.25;
  double start_sigma_rad = 0.07;
  double gyro_sigma_rad = 0.002;
  double max_age_s = 0.5;
  double unknown_speed_m_per_s = 1.0;
  double unknown_turn_rate_rad_per_s = 0.3;
  double longest_unknown_s = 10.0;
  double prior_floor_m = 0.02;
  double prior_floor_rad = 0.004;
  double prior_inflation = 9.0;
  bool features_every_scan = false;
  double clear_evidence_ratio = 0.85;
  double doubled_ratio = 0.05;
  double features_sigma_m = 0.25;
  double features_sigma_rad = 0.06;

  template <class Self, class Field>
  static void visit(Self& self, Field&& field) {
    field("start_sigma_m", self.start_sigma_m, "sigma of the start's x and y (m)");
    field("start_sigma_rad", self.start_sigma_rad, "sigma of the start's heading (rad); 4 degrees");
    field(
        "gyro_sigma_rad", self.gyro_sigma_rad,
        "sigma of the turn between two scans by the gyro (rad); the paper's steps of 0.25 degrees");
    field("max_age_s", self.max_age_s,
          "odometry or gyro fed longer before or after the scan than this is not used for it (s)");
    field("unknown_speed_m_per_s", self.unknown_speed_m_per_s,
          "sigma of the speed while odometry is missing (m/s)");
    field("unknown_turn_rate_rad_per_s", self.unknown_turn_rate_rad_per_s,
          "sigma of the turn rate while odometry is missing (rad/s)");
    field("longest_unknown_s", self.longest_unknown_s,
          "a gap without odometry counts as no longer than this (s): the machine stood, or a clock "
          "jumped");
    field(
        "prior_floor_m", self.prior_floor_m,
        "the predicted pose counts as no surer than this (m): the map's errors that one scan sees "
        "are seen again by the next");
    field("prior_floor_rad", self.prior_floor_rad, "the same for the heading (rad)");
    field("prior_inflation", self.prior_inflation,
          "the prediction's variance counts so many times where all points are fitted, so that "
          "slipping wheels do not hold the fit back");
    field("features_every_scan", self.features_every_scan,
          "match features at every scan, not only where the prediction is unsure");
    field("clear_evidence_ratio", self.clear_evidence_ratio,
          "features are matched as well where the map explained less than this of the last scan");
    field(
        "doubled_ratio", self.doubled_ratio,
        "and where more than this share of its beams on walls may have met another wall close by: "
        "in a plan that has walls twice a fit from dead reckoning alone stays with the wrong one");
    field("features_sigma_m", self.features_sigma_m,
          "a prediction less sure than this needs features to find the pose (m)");
    field("features_sigma_rad", self.features_sigma_rad, "the same for the heading (rad)");
  }
};

/// When a feature estimate is believed.
struct BeliefOptions {
  double gate_chi_square = 60.0;
  double few_pairs_gate_chi_square = 16.3;
  int few_pairs = 4;
  double map_stretch_m = 2.0;
  int min_pairs = 2;
  double max_dropped_ratio = 0.5;

  template <class Self, class Field>
  static void visit(Self& self, Field&& field) {
    field("gate_chi_square", self.gate_chi_square,
          "a fit of features farther than this from the predicted pose is refused; far beyond "
          "chance (7.3 sigma), because wheels slip more than their noise says");
    field("few_pairs_gate_chi_square", self.few_pairs_gate_chi_square,
          "the same for a fit of few pairs, which must not overrule dead reckoning; chi-square of "
          "three degrees of freedom at 1e-3");
    field("few_pairs", self.few_pairs, "a fit of fewer pairs than this has few");
    field(
        "map_stretch_m", self.map_stretch_m,
        "length of wall that shares one error of the plan (m): as far as that, the plan turns the "
        "heading that features alone give");
    field("min_pairs", self.min_pairs, "a fit of fewer pairs is refused");
    field("max_dropped_ratio", self.max_dropped_ratio,
          "a fit that had to drop a larger part of its pairs is refused");
  }
};

/// What says where the vehicle is.
enum class Estimator {
  features,  ///< the paper's feature estimate alone
  points,    ///< all points, from the predicted pose
  full,      ///< features first, then all points
};

/// Everything that the cycle needs to know beside the map.
struct LocalizerSettings {
  Estimator estimator = Estimator::full;
  ScannerModel scanner;
  std::vector<ScannerModel> more_scanners;  ///< the machine's scanners 1, 2, ...; see LaserScan
  OdometryNoise odometry;
  MapErrorOptions map;
  SweepMotionOptions motion;
  DeskewOptions deskew;
  PredictionOptions prediction;
  ExtractionOptions extraction;
  MatchingOptions matching;
  EstimationOptions estimation;
  BeliefOptions belief;
  RefinementOptions refinement;
  SearchOptions search;
  DisplacementOptions displacement;
  TrackingOptions tracking;
  StatusOptions status;
  StampOptions stamps;
  ProtectionOptions protection;
  LocalizerOptions localizer;
  RecoveryOptions recovery;
  HypothesesOptions hypotheses;
  PlaceIndexOptions places;
  RelocationOptions relocation;
  LikelihoodOptions likelihood;

  const ScannerModel& scanner_of(const LaserScan& scan) const {
    const std::size_t other = static_cast<std::size_t>(scan.scanner) - 1;
    return scan.scanner > 0 && other < more_scanners.size() ? more_scanners[other] : scanner;
  }
};

}  // namespace adit
