#pragma once

#include <memory>
#include <optional>
#include <span>

#include "adit/localizer/dead_reckoner.hpp"
#include "adit/localizer/fitter.hpp"
#include "adit/localizer/search_beside.hpp"
#include "adit/localizer/settings.hpp"
#include "adit/recovery/hypotheses.hpp"
#include "adit/tracking/pose_tracker.hpp"
#include "adit/tracking/verdict.hpp"

namespace adit {

/// What is believed of the pose after a scan.
struct Believed {
  PoseWithCovariance pose;                  ///< the estimate, map_from_vehicle
  PoseWithCovariance predicted;             ///< the same before the scan
  Matrix3d covariance = Matrix3d::Zero();   ///< of the true pose about it, over all that may be it
  std::optional<PoseWithCovariance> rival;  ///< near by, came here by dead reckoning as well
  bool is_trusted = false;
  bool has_contributed = false;  ///< the scan corrected dead reckoning
  bool is_ambiguous = false;     ///< the scan does not tell the pose from another
  bool is_anywhere = false;      ///< nothing is known of the pose
  bool is_divided = false;       ///< several poses of the mine are carried
};

/// Where the vehicle may be: the pose that is tracked, a rival near by, and, while the pose is
/// doubted or lost, all poses of the mine that a search beside the cycle has found.
///
/// Each scan goes through it in the order of the calls below.
class Belief {
 public:
  /// Map and settings must outlive it.
  Belief(const LineMap& map, const LocalizerSettings& settings,
         std::shared_ptr<const PlaceIndex> places)
      : settings_(settings), map_(map), search_(map, settings, std::move(places)) {}

  /// Forgets all; the vehicle is here, or anywhere.
  void start(const PoseWithCovariance& map_from_vehicle);
  void start_anywhere();

  /// Begins a turn: what the last scan said of trust is over.
  void begin_turn();
  /// All poses move by dead reckoning.
  void move(const Motion& motion);
  /// What the fit of the next scan is to expect.
  Expectation expectation(const Estimate& last) const;

  /// Lets the fits decide between the pose and its rival. True where they have changed places:
  /// `predicted` is another pose, and is to be fitted anew.
  bool weigh_rival(const Fits& fits);
  /// Takes what a search has found, at the scan at which it is due.
  void admit_found();
  /// Whether several poses of the mine are carried.
  bool is_divided() const { return !hypotheses_.empty(); }
  /// Holds all of them against the scan. True where another pose is followed from now on:
  /// `predicted` is that, and is to be fitted anew.
  bool weigh(const RefinementInput& input, const Fits& fits, std::span<const int> worst_walls,
             const Motion& motion);
  /// Takes the fit into the estimate if the scan explains itself there. True where the residuals of
  /// its points may teach the map's error.
  bool take_in(const Fits& fits, const Motion& motion);
  /// Begins a search in the whole mine for this scan, if one is due.
  void seek(const RefinementInput& input, const Fits& fits, const Motion& motion);

  /// By dead reckoning, before the scan is taken in.
  const PoseWithCovariance& predicted() const { return predicted_; }
  const PoseWithCovariance& pose() const { return tracker_.estimate(); }
  Believed believed() const;
  const Hypotheses& hypotheses() const { return hypotheses_; }

 private:
  /// Another pose that may be the true one, carried along until the scans have decided.
  struct Rival {
    PoseTracker tracker;
    double lead = 0.0;   // of the estimate over the rival, log of the odds
    double way_m = 0.0;  // since they parted
  };

  bool uses_points() const { return settings_.estimator != Estimator::features; }
  void add_rival(const OtherFit& other);
  bool weigh_rival(const ScanFit& rival_fit, const ScanFit& best);
  bool is_reconciled(const ScanFit& best) const;
  void change_places();
  bool take_in_features(const FeatureFix& fix);
  void take_in_points(const ScanFit& fit, const FitQuality& quality);
  bool admit(const RelocationResult& found);
  bool doubts(const RelocationResult& found) const;
  void add_tracked();
  bool follow(const Hypotheses::Hypothesis& hypothesis);
  void believe(bool is_own);
  void give_up();
  bool is_search_due(const Fits& fits);
  bool is_lost() const { return is_anywhere_ || trust_.contradicted(); }

  const LocalizerSettings& settings_;
  const LineMap& map_;
  PoseTracker tracker_;
  PoseWithCovariance predicted_;
  std::optional<Rival> rival_;
  Trust trust_;
  Hypotheses hypotheses_;
  SearchBeside search_;

  bool is_clear_ = true;       // the map explained nearly all of the last scan
  bool is_doubled_ = false;    // the plan has walls twice there
  double trusted_m_ = 0.0;     // way since the pose was found
  bool is_confirmed_ = false;  // a second search found no other pose
  bool is_anywhere_ = false;   // nothing is known of the pose
  bool is_found_ = true;       // some pose was stated or believed since the start

  // Of this turn.
  bool is_trusted_ = false;
  bool has_contributed_ = false;
  bool is_ambiguous_ = false;
};

}  // namespace adit
