#include "mine_search.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>

#include "adit/refinement/map_error.hpp"

namespace adit {

MineSearch::MineSearch(const std::vector<MineLevel>& levels, const LocalizerSettings& settings)
    : levels_(levels), settings_(settings) {
  for (const MineLevel& level : levels_) relocators_.emplace_back(level.map, *level.places);
}

MineAnswer MineSearch::locate(const LaserScan& scan, const std::optional<SweepPrior>& motion) {
  using Clock = std::chrono::steady_clock;
  const auto start = Clock::now();
  const ScannerModel& scanner = settings_.scanner_of(scan);
  const MapError stated = MapErrorEstimator(settings_.map).error();
  MineAnswer answer;
  double share_of_news = 1.0;
  double best = -std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < levels_.size(); ++i) {
    const RelocationResult& found =
        relocators_[i].locate({scan, scanner, stated, motion, std::nullopt}, settings_.relocation,
                              settings_.likelihood, settings_.refinement, settings_.status);
    for (const RankedPose& pose : found.poses) answer.poses.push_back({pose, i});
    if (found.poses.empty() || found.poses.front().log_likelihood <= best) continue;
    best = found.poses.front().log_likelihood;
    share_of_news = found.share_of_news;
    answer.verdict = found.verdict;
  }
  if (levels_.size() > 1) weigh(share_of_news, answer);
  answer.elapsed_s = std::chrono::duration<double>(Clock::now() - start).count();
  return answer;
}

/// Ranks the poses of all levels together, as each level's were among themselves.
void MineSearch::weigh(double share_of_news, MineAnswer& answer) {
  std::vector<LevelPose>& poses = answer.poses;
  if (poses.empty()) return;
  std::stable_sort(poses.begin(), poses.end(), [](const LevelPose& a, const LevelPose& b) {
    return a.ranked.log_likelihood > b.ranked.log_likelihood;
  });
  poses.resize(
      std::min(poses.size(), static_cast<std::size_t>(std::max(1, settings_.relocation.listed))));
  const double best = poses.front().ranked.log_likelihood;
  double sum = 0.0;
  for (LevelPose& pose : poses) {
    pose.ranked.weight = std::exp(share_of_news * (pose.ranked.log_likelihood - best));
    sum += pose.ranked.weight;
  }
  double elsewhere = 0.0;
  for (LevelPose& pose : poses) {
    pose.ranked.weight /= sum;
    if (pose.level != poses.front().level) elsewhere += pose.ranked.weight;
  }
  std::erase_if(poses, [&](const LevelPose& pose) {
    return pose.ranked.weight < settings_.relocation.least_weight;
  });
  const bool is_one = answer.verdict == Status::ok || answer.verdict == Status::degraded;
  if (is_one && elsewhere > settings_.relocation.rival_weight) answer.verdict = Status::ambiguous;
}

}  // namespace adit
