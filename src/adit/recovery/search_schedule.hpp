#pragma once

#include <algorithm>

namespace adit {

/// When a lost pose is looked for in the whole mine.
struct RecoveryOptions {
  bool searches = true;
  double doubtful_evidence_ratio = 0.65;
  double doubt_gain = 0.2;
  int scans_for_search = 2;
  int scans_between = 5;
  int most_scans_between = 80;
  double way_between_m = 2.0;
  int most_poses = 64;

  template <class Self, class Field>
  static void visit(Self& self, Field&& field) {
    field("searches", self.searches,
          "a pose that a scan contradicts is looked for in the whole mine; without, a start "
          "anywhere finds nothing");
    field(
        "doubtful_evidence_ratio", self.doubtful_evidence_ratio,
        "a trusted pose that explains less of a scan is looked for as well: it may be in clutter, "
        "or in a place that looks like another; 0 for never");
    field("doubt_gain", self.doubt_gain,
          "and doubted where a pose elsewhere explains so much more of the scan");
    field("scans_for_search", self.scans_for_search,
          "the search runs beside the cycle; its answer is taken so many scans after the one that "
          "was looked for, no sooner and no later, so that a replay gives the same");
    field("scans_between", self.scans_between,
          "after a search that led to nothing, so many scans pass before the next, ...");
    field("most_scans_between", self.most_scans_between,
          "... and after each further one twice as many, up to this ...");
    field("way_between_m", self.way_between_m,
          "... or so much way (m), which shows more of the mine; while several poses may be the "
          "true one as well: another may be missing among them");
    field("most_poses", self.most_poses, "a search gives up to so many poses");
  }
};

/// At which scan a search begins, and at which its answer is taken: by counting scans alone, never
/// by the clock.
class SearchSchedule {
 public:
  void begin(const RecoveryOptions& options) {
    until_answer_ = options.scans_for_search;
    way_before_m_ = way_m_;
    way_m_ = 0.0;
  }
  /// Asked once a scan while a search is under way: whether its answer is to be taken.
  bool is_answer_due() { return --until_answer_ <= 0; }

  /// The way since the last scan.
  void drive(double metres) { way_m_ += metres; }
  /// Whether so much way has passed since the last search that another may find more.
  bool is_elsewhere(const RecoveryOptions& options) const {
    return way_m_ >= options.way_between_m;
  }
  /// The way between the last search and the one before.
  double way_before_m() const { return way_before_m_; }
  /// Asked once a scan while the pose is lost: whether to begin a search.
  bool is_search_due() { return --until_search_ < 0; }
  /// A search led to nothing: the next comes later.
  void note_failure(const RecoveryOptions& options) {
    until_search_ = std::max(options.scans_between, next_wait_);
    next_wait_ = std::min(2 * until_search_, options.most_scans_between);
  }
  /// The pose is known: the next loss is looked for at once.
  void note_success() { until_search_ = next_wait_ = 0; }

 private:
  int until_answer_ = 0;  // scans
  int until_search_ = 0;
  double way_m_ = 0.0;  // since the last search began
  double way_before_m_ = 0.0;
  int next_wait_ = 0;  // after the next failure
};

}  // namespace adit
