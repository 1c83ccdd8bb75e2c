#pragma once

#include <memory>
#include <utility>

#include "adit/localizer/dead_reckoner.hpp"
#include "adit/localizer/settings.hpp"
#include "adit/recovery/place_finder.hpp"
#include "adit/recovery/search_schedule.hpp"
#include "adit/tracking/pose_tracker.hpp"

namespace adit {

/// The search in the whole mine that runs beside the cycle: when it begins, at which scan its
/// answer is taken, and the way since the scan that is looked for.
class SearchBeside {
 public:
  /// Map and settings must outlive it.
  SearchBeside(const LineMap& map, const LocalizerSettings& settings,
               std::shared_ptr<const PlaceIndex> places)
      : settings_(settings), finder_(map, std::move(places)) {}

  /// Forgets all; waits for a search that is under way.
  void reset();

  bool is_searching() const { return finder_.is_searching(); }
  /// Asked once a scan: whether the answer of a search under way is to be taken.
  bool is_answer_due() { return is_searching() && schedule_.is_answer_due(); }
  RelocationResult take() { return finder_.take(); }
  /// Begins a search for the scan. One for a pose that is trusted is a doubt; `explained` is what
  /// that pose explains of it (share).
  void begin(const RelocationQuery& query, bool is_doubt, double explained);
  /// How it searches.
  PlaceFinderOptions finder_options() const;

  /// Dead reckoning from where the scan that is looked for was taken.
  void move(const Motion& motion) { carry(motion, settings_.tracking, since_begun_); }
  const PoseWithCovariance& since_begun() const { return since_begun_.estimate(); }
  bool is_doubt() const { return is_doubt_; }
  double explained() const { return explained_; }

  /// When to search: for a pose that is lost, and for one that is trusted and doubted.
  SearchSchedule& schedule() { return schedule_; }
  SearchSchedule& doubts() { return doubts_; }

 private:
  const LocalizerSettings& settings_;
  PlaceFinder finder_;
  SearchSchedule schedule_;
  SearchSchedule doubts_;
  PoseTracker since_begun_;
  bool is_doubt_ = false;
  double explained_ = 0.0;
};

}  // namespace adit
