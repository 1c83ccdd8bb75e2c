#include "replay.hpp"

#include <cmath>
#include <utility>

#include "adit/scan/sweep_timing.hpp"
#include "progress.hpp"

namespace adit {
Replayer::Replayer(const std::vector<StampedPose>& odometry, const LineMap& map,
                   const LocalizerSettings& settings, const Beginning& beginning,
                   std::shared_ptr<const PlaceIndex> places)
    : odometry_(odometry),
      settings_(settings),
      beginning_(beginning),
      localizer_(map, settings, std::move(places)) {}

void Replayer::feed_odometry(const LogScan& entry) {
  const ScannerModel& scanner = settings_.scanner_of(entry.scan);
  const double sweep_end = entry.scan.stamp + sweep_timing(scanner, 1).at(1);
  for (; next_message_ < odometry_.size(); ++next_message_) {
    const StampedPose& message = odometry_[next_message_];
    const bool same_clock = std::abs(message.stamp - entry.scan.stamp) <= settings_.stamps.jump_s;
    const bool is_due =
        next_message_ < entry.odometry_before || (same_clock && message.stamp <= sweep_end);
    if (!is_due) return;
    if (same_clock) localizer_.add_odometry(message);
  }
}

EstimateRow Replayer::add(const LogScan& entry) {
  if (!has_begun_) {
    if (beginning_.is_anywhere) {
      localizer_.start_anywhere();
    } else {
      localizer_.start(beginning_.pose.value_or(entry.odom_from_vehicle), beginning_.covariance);
    }
    has_begun_ = true;
  }
  feed_odometry(entry);
  return to_row(localizer_.update(entry.scan, entry.odom_from_vehicle));
}

Replay replay(const Log& log, const LineMap& map, const LocalizerSettings& settings,
              const Beginning& beginning, std::shared_ptr<const PlaceIndex> places) {
  Replay result;
  Replayer replayer(log.odometry, map, settings, beginning, std::move(places));
  const Localizer& localizer = replayer.localizer();
  Progress progress("localizing", log.scans.size());
  for (const LogScan& entry : log.scans) {
    result.rows.push_back(replayer.add(entry));
    result.timings.push_back(localizer.last_turn().timings);
    result.search_calls.push_back(localizer.last_turn().match.calls);
    progress.advance();
  }
  result.map_error = localizer.last_turn().map_error;
  result.stamps = localizer.last_turn().stamps;
  return result;
}

}  // namespace adit
