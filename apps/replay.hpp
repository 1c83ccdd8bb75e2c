#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "adit/io/estimates.hpp"
#include "adit/io/log.hpp"
#include "adit/localizer/localizer.hpp"

namespace adit {

/// A log through the localizer, in the log's order: one row and one set of timings a scan.
struct Replay {
  std::vector<EstimateRow> rows;
  std::vector<Timings> timings;
  std::vector<int> search_calls;
  MapError map_error;  ///< as believed after the last scan
  StampCounts stamps;
};

/// What is known of the vehicle before the first scan.
struct Beginning {
  bool is_anywhere = false;            ///< nothing at all
  std::optional<Pose2> pose;           ///< map_from_vehicle; none: the first odometry pose
  std::optional<Matrix3d> covariance;  ///< none: the localizer's own
};

/// Gives each scan its own odometry pose, and the localizer those of the log's ODOM messages that a
/// machine would have when the scan's sweep is over: all that the log has before the scan, and what
/// follows up to the sweep's end. Messages stamped by a clock that is not the scans' are left out.
///
/// `places`, if given, is the index of the map for searches.
Replay replay(const Log& log, const LineMap& map, const LocalizerSettings& settings,
              const Beginning& beginning, std::shared_ptr<const PlaceIndex> places);

/// The same of scans that come one by one.
class Replayer {
 public:
  /// `odometry`: the log's ODOM messages; all that is given must outlive it.
  Replayer(const std::vector<StampedPose>& odometry, const LineMap& map,
           const LocalizerSettings& settings, const Beginning& beginning,
           std::shared_ptr<const PlaceIndex> places = nullptr);

  EstimateRow add(const LogScan& entry);
  const Localizer& localizer() const { return localizer_; }

 private:
  void feed_odometry(const LogScan& entry);

  const std::vector<StampedPose>& odometry_;
  const LocalizerSettings& settings_;
  Beginning beginning_;
  Localizer localizer_;
  std::size_t next_message_ = 0;  // each goes to the localizer at most once
  bool has_begun_ = false;
};

}  // namespace adit
