#include "drive_run.hpp"

#include <algorithm>

#include "adit/simulation/scanner.hpp"
#include "beam_bound.hpp"
#include "oracle.hpp"

namespace adit {
namespace {

constexpr std::size_t kBoundEvery = 5;  // scans

/// Whether the machine stops for each scan.
bool is_stopping(const Recording& recording) {
  constexpr double kApart = 1.0;  // s; on the move scans come several times a second
  const std::vector<StampedPose>& truth = recording.truth;
  return truth.size() > 1 && truth[1].stamp - truth[0].stamp > kApart;
}

/// The bound of every fifth scan, of all where the machine stops for each.
class BoundAlong {
 public:
  explicit BoundAlong(const Scene& scene)
      : scene_(scene),
        mine_(LineMap::build(scene.world.walls)),
        bound_(mine_, as_mounted(scene.scanner())),
        every_(is_stopping(scene.recording) ? 1 : kBoundEvery) {}

  void add(std::size_t scan, const JudgedAnswer& answer, Counting& counting) {
    if (scene_.recording.scans[scan].scanner != 0) return;
    if (seen_++ % every_ != 0 || !answer.is_answer() || answer.is_wrong()) return;
    const StampedPose& truth = scene_.recording.truth[scan];
    std::vector<Segment> others = passing_segments(scene_.world, truth);
    others.insert(others.end(), scene_.world.clutter.begin(), scene_.world.clutter.end());
    const auto variance =
        bound_.position_variance(scene_.recording.scans[scan], truth.pose, others);
    if (variance) counting.add_bound(answer, *variance);
  }

 private:
  const Scene& scene_;
  LineMap mine_;
  WallBeamBound bound_;
  std::size_t every_;
  std::size_t seen_ = 0;  // scans of the first scanner
};

double moved_at(const Recording& recording, std::size_t scan) {
  if (scan == 0) return 0.0;
  const auto at = [&](std::size_t i) { return recording.truth[i].pose.translation(); };
  return (at(scan) - at(scan - 1)).norm();
}

}  // namespace

std::int64_t count_untold(const Scene& scene, const std::vector<Pose2>& believed,
                          const std::vector<bool>& is_wrong) {
  const auto last = std::find(is_wrong.rbegin(), is_wrong.rend(), true).base();
  const auto scans = static_cast<std::size_t>(last - is_wrong.begin());
  if (scans == 0) return 0;
  const RayCaster mine(scene.world.walls);
  std::vector<ScanOracle> oracles;
  for (const ScannerSpec& spec : scene.scanners) oracles.emplace_back(mine, as_mounted(spec));
  LeadSum sum;
  std::int64_t untold = 0;
  for (std::size_t i = std::min(scene.fault_at, scans - 1); i < scans && !sum.is_settled(); ++i) {
    const LaserScan& scan = scene.recording.scans[i];
    const ScanOracle& oracle = oracles[static_cast<std::size_t>(scan.scanner)];
    sum.add(oracle.lead_of_truth(scan, scene.recording.truth[i].pose, believed[i]));
    untold += is_wrong[i] && !sum.tells() ? 1 : 0;
  }
  return untold;
}

DriveCounts run_drive(const Scene& scene, std::int64_t drive) {
  const Recording& recording = scene.recording;
  Localizer localizer(scene.map(), scene.settings, scene.index());
  if (scene.start) {
    localizer.start(scene.start->pose, scene.start->covariance);
  } else {
    localizer.start_anywhere();
  }
  BoundAlong bound(scene);
  Counting counting(drive);
  std::vector<Pose2> believed;
  std::vector<bool> is_wrong;
  const std::size_t news_at = scene.news_at.value_or(scene.fault_at);
  for (std::size_t i = 0; i < recording.scans.size(); ++i) {
    const LaserScan& scan = recording.scans[i];
    const auto odometry = recording.odometry_at(i);
    const Estimate& estimate =
        odometry ? localizer.update(scan, *odometry) : localizer.update(scan);
    const bool is_hop = i == scene.fault_at && !scene.after.empty();
    JudgedAnswer answer =
        judged(estimate, recording.truth[i].pose, is_hop ? 0.0 : moved_at(recording, i),
               localizer.last_turn().timings.total());
    answer.is_news = i >= news_at;
    counting.add(answer);
    bound.add(i, answer, counting);
    believed.push_back(estimate.pose);
    is_wrong.push_back(answer.is_wrong());
  }
  DriveCounts counts = counting.finished();
  counts.untold = count_untold(scene, believed, is_wrong);
  return counts;
}

}  // namespace adit
