#include "adit/relocation/place_search.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace adit {
namespace {

bool scores_more(const PlaceMatch& a, const PlaceMatch& b) {
  const Pose2& p = a.map_from_laser;
  const Pose2& q = b.map_from_laser;
  return std::tie(b.score, p.y, p.x, p.theta) < std::tie(a.score, q.y, q.x, q.theta);
}

std::size_t corners_moved(const PlaceIndex& index, const RelocationOptions& options) {
  return part_of(index.corners().size(), options.corners_moved_share, options.corners_moved);
}

// Matches that were moved to within this of each other are one (m, rad).
constexpr double kSameMetres = 0.5;
constexpr double kSameRadians = radians(3.0);

}  // namespace

std::span<const PlaceMatch> PlaceSearch::find(const PlaceIndex& index, const LaserScan& scan,
                                              const ScannerModel& scanner,
                                              const std::optional<SearchArea>& area,
                                              const RelocationOptions& options) {
  const auto views = view_search_.find(index, scan, scanner, area, options);
  const auto corners = corner_search_.find(index, scan, scanner, area,
                                           corners_moved(index, options), options.corners);
  return move(index, scan, scanner, views, corners, options);
}

std::span<const PlaceMatch> PlaceSearch::find_again(const PlaceIndex& index, const LaserScan& scan,
                                                    const ScannerModel& scanner,
                                                    const std::optional<SearchArea>& area,
                                                    const RelocationOptions& options) {
  const auto views = view_search_.find(index, scan, scanner, area, options);
  const auto corners = corner_search_.take(index, corners_moved(index, options));
  return move(index, scan, scanner, views, corners, options);
}

std::span<const PlaceMatch> PlaceSearch::move(const PlaceIndex& index, const LaserScan& scan,
                                              const ScannerModel& scanner,
                                              std::span<const PlaceMatch> views,
                                              std::span<const PlaceMatch> corners,
                                              const RelocationOptions& options) {
  matches_.clear();
  quick_fit_.set_scan(scan, scanner, count_of(options.first_beams));
  approach(index.walls(), views,
           part_of(index.size(), options.moved_again_share, options.moved_again));
  approach(index.walls(), corners,
           part_of(index.corners().size(), options.corners_moved_again_share,
                   options.corners_moved_again));
  quick_fit_.set_scan(scan, scanner, count_of(options.quick_beams));
  settle(index.walls(), options);
  choose(options);
  return found_;
}

/// Moves poses towards the walls and takes the best of them, so many.
void PlaceSearch::approach(const WallField& walls, std::span<const PlaceMatch> matches,
                           std::size_t most) {
  approached_.assign(matches.begin(), matches.end());
  for (PlaceMatch& match : approached_) {
    const QuickFit::Result moved = quick_fit_.approach(walls, match.map_from_laser);
    match.map_from_laser = moved.map_from_laser;
    match.score += moved.agreement;
  }
  if (approached_.size() > most) {
    std::nth_element(approached_.begin(), approached_.begin() + static_cast<std::ptrdiff_t>(most),
                     approached_.end(), scores_more);
    approached_.resize(most);
  }
  matches_.insert(matches_.end(), approached_.begin(), approached_.end());
}

/// Moves what was taken all the way. What returns say from behind walls weighs against the rest; it
/// is asked only of those that may be chosen.
void PlaceSearch::settle(const WallField& walls, const RelocationOptions& options) {
  for (PlaceMatch& match : matches_) {
    const QuickFit::Result moved = quick_fit_.settle(walls, match.map_from_laser);
    match.map_from_laser = moved.map_from_laser;
    match.agreement = match.score = moved.agreement;
  }
  std::sort(matches_.begin(), matches_.end(), scores_more);
  const auto per_through = static_cast<float>(options.agreement_per_through);
  const auto slack = static_cast<float>(options.score_slack);
  const std::size_t fewest = count_of(options.fewest_candidates);
  float best = -1.0F;
  std::size_t rated = 0;
  for (; rated < matches_.size(); ++rated) {
    PlaceMatch& match = matches_[rated];
    if (rated >= fewest && match.agreement < best - slack) break;
    match.score -= per_through * quick_fit_.through(walls, match.map_from_laser);
    best = std::max(best, match.score);
  }
  matches_.resize(rated);
}

/// Those no farther behind the first than by the slack. Of those that are one, the pose that agrees
/// most with the walls stands for them.
void PlaceSearch::choose(const RelocationOptions& options) {
  const std::size_t fewest = count_of(options.fewest_candidates);
  const std::size_t most = count_of(options.candidates);
  const auto slack = static_cast<float>(options.score_slack);
  found_.clear();
  std::sort(matches_.begin(), matches_.end(), scores_more);
  for (const PlaceMatch& match : matches_) {
    const auto known = std::find_if(found_.begin(), found_.end(), [&](const PlaceMatch& better) {
      return is_near(better.map_from_laser, match.map_from_laser, kSameMetres, kSameRadians);
    });
    if (known != found_.end()) {
      if (known->agreement < match.agreement) known->map_from_laser = match.map_from_laser;
      known->agreement = std::max(known->agreement, match.agreement);
      continue;
    }
    if (found_.size() >= most) break;
    if (found_.size() >= fewest && match.score < found_.front().score - slack) break;
    found_.push_back(match);
  }
}

}  // namespace adit
