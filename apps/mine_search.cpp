#include "mine_search.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>

#include "adit/refinement/map_error.hpp"
#include "adit/relocation/place_verdict.hpp"

namespace adit {

namespace {

double likeliest(const RelocationResult& found) { return found.poses.front().log_likelihood; }

}  // namespace

MineSearch::MineSearch(const std::vector<MineLevel>& levels, const LocalizerSettings& settings)
    : levels_(levels), settings_(settings) {
  for (const MineLevel& level : levels_) relocators_.emplace_back(level.map, *level.places);
}

MineAnswer MineSearch::locate(const LaserScan& scan, const std::optional<SweepPrior>& motion) {
  using Clock = std::chrono::steady_clock;
  const auto start = Clock::now();
  const ScannerModel& scanner = settings_.scanner_of(scan);
  const MapError stated = MapErrorEstimator(settings_.map).error();
  const RelocationQuery query{scan, scanner, stated, motion, std::nullopt};
  MineAnswer answer;
  RelocationResult best;
  double best_elsewhere = -std::numeric_limits<double>::infinity();
  std::size_t places = 0;
  for (std::size_t i = 0; i < levels_.size(); ++i) {
    const RelocationResult& found = relocators_[i].locate(
        query, settings_.relocation, settings_.likelihood, settings_.refinement, settings_.status);
    for (const RankedPose& pose : found.poses) answer.poses.push_back({pose, i});
    places += relocators_[i].places();
    if (found.poses.empty()) continue;
    const bool is_best = best.poses.empty() || likeliest(found) > likeliest(best);
    const RelocationResult& other = is_best ? best : found;
    if (!other.poses.empty()) best_elsewhere = std::max(best_elsewhere, likeliest(other));
    if (is_best) best = found;
  }
  answer.verdict = best.verdict;
  if (levels_.size() > 1 && !best.poses.empty()) {
    const double lead = best.share_of_news * (likeliest(best) - best_elsewhere);
    best.gap = std::min(best.gap, lead);
    answer.verdict = judge_place(best, query, places, settings_.relocation, settings_.status);
    weigh(best.share_of_news, answer);
  }
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
