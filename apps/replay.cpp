#include "replay.hpp"

#include <cmath>
#include <utility>

#include "adit/scan/sweep_timing.hpp"
#include "progress.hpp"

namespace adit {
namespace {

/// The log's ODOM messages on their way to the localizer, each at most once.
class OdometryFeed {
 public:
  OdometryFeed(const Log& log, const LocalizerSettings& settings)
      : messages_(log.odometry), settings_(settings) {}

  void before(const LogScan& entry, Localizer& localizer) {
    const ScannerModel& scanner = settings_.scanner_of(entry.scan);
    const double sweep_end = entry.scan.stamp + sweep_timing(scanner, 1).at(1);
    for (; next_ < messages_.size(); ++next_) {
      const StampedPose& message = messages_[next_];
      const bool same_clock = std::abs(message.stamp - entry.scan.stamp) <= settings_.stamps.jump_s;
      const bool is_due =
          next_ < entry.odometry_before || (same_clock && message.stamp <= sweep_end);
      if (!is_due) return;
      if (same_clock) localizer.add_odometry(message);
    }
  }

 private:
  const std::vector<StampedPose>& messages_;
  const LocalizerSettings& settings_;
  std::size_t next_ = 0;
};

void begin(Localizer& localizer, const Beginning& beginning, const Log& log) {
  if (beginning.is_anywhere) {
    localizer.start_anywhere();
  } else {
    localizer.start(beginning.pose.value_or(log.scans.front().odom_from_vehicle),
                    beginning.covariance);
  }
}

}  // namespace

Replay replay(const Log& log, const LineMap& map, const LocalizerSettings& settings,
              const std::optional<Pose2>& start) {
  return replay(log, map, settings, Beginning{false, start, std::nullopt}, nullptr);
}

Replay replay(const Log& log, const LineMap& map, const LocalizerSettings& settings,
              const Beginning& beginning, std::shared_ptr<const PlaceIndex> places) {
  Replay result;
  Localizer localizer(map, settings, std::move(places));
  begin(localizer, beginning, log);
  OdometryFeed odometry(log, settings);
  Progress progress("localizing", log.scans.size());
  for (const LogScan& entry : log.scans) {
    odometry.before(entry, localizer);
    result.rows.push_back(to_row(localizer.update(entry.scan, entry.odom_from_vehicle)));
    result.timings.push_back(localizer.timings());
    result.search_calls.push_back(localizer.match().calls);
    progress.advance();
  }
  result.map_error = localizer.map_error();
  result.stamps = localizer.stamp_counts();
  return result;
}

}  // namespace adit
