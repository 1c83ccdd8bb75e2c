#pragma once

#include <optional>

#include "adit/geometry/pose2.hpp"
#include "adit/tracking/estimate.hpp"

namespace adit {

/// When a scan explains the pose, and when it shows all of it.
struct StatusOptions {
  double least_evidence_ratio = 0.3;
  double evidence_per_behind = 2.0;
  double most_evidence_ratio = 0.55;
  double used_evidence_ratio = 0.15;
  double regain_evidence_ratio = 0.75;
  double disagreeing_drop = 0.08;
  double regain_slack = 0.15;
  double regain_way_m = 5.0;
  double fewest_returns = 20.0;
  double least_wall_ratio = 0.3;
  double most_behind_ratio = 0.5;
  double degraded_sigma_m = 0.5;
  double degraded_sigma_rad = 0.1;
  double ambiguous_gain = 3.0;
  double rival_gain = 7.0;
  double rival_way_m = 20.0;
  double rival_evidence_ratio = 0.6;
  double reconciled_chi_square = 6.25;
  double jump_chi_square = 30.0;
  double sudden_evidence_ratio = 0.15;
  double sudden_behind_ratio = 0.02;
  double sudden_drop_ratio = 0.3;
  double usual_scans = 4.0;
  double first_evidence_ratio = 0.85;
  double first_behind_ratio = 0.02;

  template <class Self, class Field>
  static void visit(Self& self, Field&& field) {
    visit_trust(self, field);
    visit_rivals(self, field);
    visit_sudden(self, field);
  }

 private:
  template <class Self, class Field>
  static void visit_trust(Self& self, Field& field) {
    field("least_evidence_ratio", self.least_evidence_ratio,
          "a scan of which the map explains less than this share does not fit the pose: lost");
    field("evidence_per_behind", self.evidence_per_behind,
          "so many times the share of returns from behind the map's walls is asked beside it: what "
          "stands in the way is common, seeing through rock is not");
    field("most_evidence_ratio", self.most_evidence_ratio, "but no more than this is asked");
    field("used_evidence_ratio", self.used_evidence_ratio,
          "a lost scan of which so much is explained still corrects dead reckoning, if the two "
          "agree");
    field("regain_evidence_ratio", self.regain_evidence_ratio,
          "where the scan lies beyond the tracking's gate, so much must be explained; and "
          "after a contradiction where no scan has yet shown what is usual");
    field(
        "disagreeing_drop", self.disagreeing_drop,
        "a scan beyond that gate of which less is explained than is usual here by this contradicts "
        "the pose: two oddities at once are no chance");
    field("regain_slack", self.regain_slack,
          "after a scan that contradicted the pose, as much must be explained as is usual here but "
          "for this ...");
    field("regain_way_m", self.regain_way_m,
          "... for so long a way (m) before the pose is trusted again: mines look like themselves");
    field("fewest_returns", self.fewest_returns,
          "a scan of fewer returns contradicts nothing: the scanner is blind");
    field("least_wall_ratio", self.least_wall_ratio,
          "a smaller share of the returns on the map's walls: lost");
    field("most_behind_ratio", self.most_behind_ratio,
          "more returns than this share from behind the map's walls: lost");
    field("degraded_sigma_m", self.degraded_sigma_m,
          "a direction that the scan shows less well than this comes from dead reckoning (m)");
    field("degraded_sigma_rad", self.degraded_sigma_rad, "the same for the heading (rad)");
  }

  template <class Self, class Field>
  static void visit_rivals(Self& self, Field& field) {
    field("ambiguous_gain", self.ambiguous_gain,
          "another pose that explains the scan as well but for this (log of the likelihoods' "
          "ratio) makes it ambiguous");
    field("rival_gain", self.rival_gain,
          "one that is less likely by up to this counts in the protection level; e^-7 is 1e-3");
    field("rival_way_m", self.rival_way_m,
          "a rival is kept for this way at least (m): until walls are in sight that were not where "
          "the two parted");
    field("rival_evidence_ratio", self.rival_evidence_ratio,
          "after that, one that explains less than this share of what the estimate explains is "
          "dropped");
    field("reconciled_chi_square", self.reconciled_chi_square,
          "a rival that the estimate is no farther from than this, for the rival's own doubt, is "
          "none; 10 % of three degrees of freedom");
    field("jump_chi_square", self.jump_chi_square,
          "a scan farther than this from dead reckoning, far beyond chance, says that the vehicle "
          "is elsewhere: ambiguous until the next");
  }

  template <class Self, class Field>
  static void visit_sudden(Self& self, Field& field) {
    field("sudden_evidence_ratio", self.sudden_evidence_ratio,
          "a scan that is explained less well than the last few by this ...");
    field("sudden_behind_ratio", self.sudden_behind_ratio,
          "... and of which more than of those, by this, comes from behind the map's walls "
          "contradicts "
          "the pose: what stands in the way makes no beam longer");
    field("sudden_drop_ratio", self.sudden_drop_ratio,
          "one that is explained less well by this contradicts it whatever it shows: nothing that "
          "drives into sight hides so much from one scan to the next");
    field("usual_scans", self.usual_scans, "what is usual is known after so many scans");
    field("first_evidence_ratio", self.first_evidence_ratio,
          "before, so much of what could be explained is taken for usual ...");
    field("first_behind_ratio", self.first_behind_ratio,
          "... and so much of the returns behind the map's walls");
  }
};

/// What a fit of all points says of how well it explains the scan; shares of the returns.
struct FitQuality {
  bool converged = false;
  bool agrees = true;           ///< with dead reckoning, by the tracking's gate
  double evidence_ratio = 0.0;  ///< of what a scan of nothing but the map's walls would give
  double returns = 0.0;
  double wall_ratio = 0.0;
  double behind_ratio = 0.0;
};

/// Whether the pose explains the scan.
bool explains(const FitQuality& quality, const StatusOptions& options);

/// Trust in the pose over time: lost by a scan that contradicts it, and regained on the way.
class Trust {
 public:
  /// The next scan's fit, and the way (m) since the last scan. True while the pose may be trusted.
  /// Of a fit that disagrees with dead reckoning more is asked than to explain the scan.
  bool next(const FitQuality& quality, double way_m, const StatusOptions& options);
  void reset() { *this = Trust{}; }
  /// Something else than a scan speaks against the pose.
  void doubt() {
    contradicted_ = true;
    regained_m_ = 0.0;
  }
  /// Whether a scan, or `doubt`, contradicted the pose and it has not been regained since.
  bool contradicted() const { return contradicted_; }

 private:
  void note_usual(const FitQuality& quality);
  double usual(const StatusOptions& options) const;
  bool is_sudden(const FitQuality& quality, const StatusOptions& options) const;
  bool disagrees(const FitQuality& quality, const StatusOptions& options) const;

  bool contradicted_ = false;
  double usual_ = 0.0;          // evidence ratio while trusted, of so many scans, a sliding mean
  double recent_ = 0.0;         // of the last few of them
  double recent_behind_ = 0.0;  // the same of the returns behind the map's walls
  double scans_ = 0.0;
  double regained_m_ = 0.0;
};

/// The direction (unit vector, map axes) that a fix with this covariance leaves open, if it does; a
/// zero vector where it is the heading that is open.
std::optional<Vector2d> open_direction(const Matrix3d& fix_covariance,
                                       const StatusOptions& options);

}  // namespace adit
