#pragma once

#include <optional>
#include <span>
#include <vector>

#include "adit/recovery/drive_memory.hpp"
#include "adit/refinement/refinement.hpp"
#include "adit/tracking/pose_tracker.hpp"
#include "adit/tracking/verdict.hpp"

namespace adit {

/// When one of several poses may be believed, and when one is given up.
struct HypothesesOptions {
  double sure_weight = 0.999;
  double least_weight = 1e-6;
  int scans_to_confirm = 2;
  double way_to_confirm_m = 3.0;
  int scans_to_refute = 2;
  double sure_evidence_ratio = 0.75;
  double own_gain = 3.0;
  double own_way_m = 10.0;
  double unlisted_lead = 9.0;
  double independent_way_m = 2.0;
  double same_place_m = 0.5;
  double same_heading_rad = 0.1;
  int most_carried = 64;
  DriveMemoryOptions memory;

  template <class Self, class Field>
  static void visit(Self& self, Field&& field) {
    field("sure_weight", self.sure_weight,
          "a pose is believed again when its weight among all that explain the scans is this");
    field("least_weight", self.least_weight, "one of less weight than this is given up");
    field("scans_to_confirm", self.scans_to_confirm,
          "so many scans in a row must be explained before a pose is believed ...");
    field("way_to_confirm_m", self.way_to_confirm_m,
          "... over so much way (m), unless dead reckoning has it there as well: mines look like "
          "themselves");
    field("scans_to_refute", self.scans_to_refute,
          "one that so many scans in a row contradict is given up");
    field(
        "sure_evidence_ratio", self.sure_evidence_ratio,
        "to confirm a pose that a search has found, a scan must be explained to this share of what "
        "one of nothing but the map's walls would give, and show all of it");
    field("own_gain", self.own_gain,
          "log of the odds of the pose by dead reckoning over one that a search found");
    field("own_way_m", self.own_way_m,
          "a pose by dead reckoning that was trusted for less than this way (m) is one of the "
          "others");
    field(
        "unlisted_lead", self.unlisted_lead,
        "searches that list no more than some of the poses leave room for another, until the pose "
        "leads those that were left out by this (log of the odds, over searches on the way)");
    field("independent_way_m", self.independent_way_m,
          "a scan is news in full after so much way since the last (m); before, it sees the same "
          "walls again");
    field("same_place_m", self.same_place_m,
          "poses nearer to each other than this are one (m) ...");
    field("same_heading_rad", self.same_heading_rad, "... if no more turned than this (rad)");
    field("most_carried", self.most_carried, "no more poses than this are carried");
    DriveMemoryOptions::visit(self.memory, field);
  }
};

/// Whether two poses are the same but for what searches and fits leave of doubt.
bool are_one(const Pose2& a, const Pose2& b, const HypothesesOptions& options);

/// What the next scan is held against the hypotheses with.
struct HypothesesTurn {
  const RefinementInput& input;
  double way_m = 0.0;  ///< since the last scan
  const RefinementOptions& refinement;
  const TrackingOptions& tracking;
  const StatusOptions& status;
  /// The pose by dead reckoning as it was before the scan, the scan's fit there, and the walls that
  /// gainsay it most; of use while `has_own`.
  const PoseTracker& own;
  const ScanFit& own_fit;
  std::span<const int> own_worst_walls;
};

/// Poses of which any may be the true one, carried along until motion and scans have decided.
///
/// Each has its own filter; every scan weighs all of them. Two that meet become one; one that the
/// scans contradict, or that weighs nothing beside the others, is given up.
class Hypotheses {
 public:
  struct Hypothesis {
    PoseTracker tracker;    // with the last scan taken in
    PoseTracker predicted;  // without
    double log_odds = 0.0;
    double weight = 0.0;         // of all
    int explained = 0;           // scans in a row ...
    double explained_m = 0.0;    // ... and their way
    int contradicted = 0;        // scans in a row
    bool is_own = false;         // by dead reckoning
    double unlisted_lead = 0.0;  // over poses that all searches left out (log)
  };

  void clear() {
    all_.clear();
    memory_.clear();
    leading_past_.reset();
    has_new_ = false;
  }
  bool empty() const { return all_.empty(); }
  /// Whether none is left but the one by dead reckoning, and the last scan does not explain it.
  bool is_hopeless() const {
    return all_.size() == 1 && all_.front().is_own && all_.front().contradicted > 0;
  }
  std::size_t size() const { return all_.size(); }
  /// Whether the pose that dead reckoning has kept is among them.
  bool has_own() const { return own() != nullptr; }

  /// The pose that dead reckoning has kept. It stays until another is believed: a plan that is
  /// wrong at one place explains scans better elsewhere, but not for long.
  void add_own(const PoseTracker& tracker, const HypothesesOptions& options);
  /// Another, that a search has found. False if it is held already.
  bool add(const PoseWithCovariance& map_from_vehicle, const HypothesesOptions& options);
  /// The same while others are carried: it is held against the scans of the way as they were. False
  /// as well if these refute it, or leave it too unlikely to matter.
  bool add_late(const PoseWithCovariance& map_from_vehicle, const FitRules& rules,
                const HypothesesOptions& options);

  /// What a search listed, for hypotheses and what is none yet, and how much likelier each is than
  /// any that is not listed (log); `way_m` is that since the last search.
  struct Listed {
    Pose2 pose;
    double lead = 0.0;
  };
  void note_listed(std::span<const Listed> listed, double way_m, const HypothesesOptions& options);

  void predict(const Pose2& move, const OdometryNoise& noise, const TrackingOptions& options);
  /// Time without dead reckoning: all may have moved by this.
  void blur(double metres, double radians);

  /// Takes the scan in; afterwards the most plausible comes first.
  void weigh(const HypothesesTurn& turn, const HypothesesOptions& options);

  /// The one by dead reckoning while it may be the true one, else the most plausible; there is one
  /// unless `empty`.
  const Hypothesis& leader() const;
  /// Of the true pose about this one, over (x, y, theta), whichever hypothesis is right; there is
  /// one unless `empty`.
  Matrix3d covariance_about(const Pose2& pose) const;
  /// Whether the most plausible may be believed.
  bool is_decided(const HypothesesOptions& options) const;
  /// Whether the most plausible leads all that no search has listed.
  bool leads_unlisted(const HypothesesOptions& options) const {
    return !all_.empty() && all_.front().unlisted_lead >= options.unlisted_lead;
  }
  /// The most plausible first.
  const std::vector<Hypothesis>& all() const { return all_; }

 private:
  Witness take_in(Hypothesis& hypothesis, const HypothesesTurn& turn,
                  const HypothesesOptions& options);
  static void judge(Testimony says, const HypothesesTurn& turn, Hypothesis& hypothesis);
  bool holds_but_for_a_wall(const HypothesesTurn& turn, const PoseWithCovariance& start);
  void raise_odds(double news);
  double lead_over_first(const Retrospect& past) const;
  void remember(const HypothesesTurn& turn, const HypothesesOptions& options);
  /// The one by dead reckoning, or null.
  const Hypothesis* own() const;
  void drop_contradicted(const HypothesesOptions& options);
  void merge(const HypothesesOptions& options);
  void normalise(const HypothesesOptions& options);

  std::vector<Hypothesis> all_;
  std::vector<Witness> witnesses_;
  bool has_new_ = false;  // since the last scan
  DriveMemory memory_;
  std::optional<Retrospect> leading_past_;  // of the first, until the next scan
  Refiner refiner_;
};

}  // namespace adit
