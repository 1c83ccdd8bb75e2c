#include "adit/relocation/corner_search.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>

namespace adit {
namespace {

// A rating is a byte.
constexpr float kFullRating = 255.0F;

double direction_of(const Vector2d& along) { return std::atan2(along.y(), along.x()); }

}  // namespace

std::span<const PlaceMatch> CornerSearch::find(const PlaceIndex& index, const LaserScan& scan,
                                               const ScannerModel& scanner,
                                               const std::optional<SearchArea>& area,
                                               std::size_t most,
                                               const CornerSearchOptions& options) {
  options_ = options;
  sense(scan, scanner);
  choose_corners(index.corners());
  few_returns_.set_scan(scan, scanner, count_of(options.returns));
  rate(index, area);
  return take(index, most);
}

/// The corners that walls of the scan make with each other, each with the space in which the
/// scanner stands.
void CornerSearch::sense(const LaserScan& scan, const ScannerModel& scanner) {
  sensed_.clear();
  const FeatureList& features = extractor_.extract(scan, scanner, options_.extraction);
  const auto& lines = features.lines;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    for (std::size_t j = i + 1; j < lines.size(); ++j) {
      const auto met = corner_of({lines[i].begin, lines[i].end}, {lines[j].begin, lines[j].end},
                                 options_.limits);
      if (!met) continue;
      const double a = direction_of(met->along_a);
      const double b = direction_of(met->along_b);
      const bool is_from_a = turned(a, direction_of(-met->point)) < turned(a, b);
      const double square_a = lines[i].length() * lines[i].length();
      const double square_b = lines[j].length() * lines[j].length();
      Sensed sensed;
      sensed.x = static_cast<float>(met->point.x());
      sensed.y = static_cast<float>(met->point.y());
      const Vector2d& along = is_from_a ? met->along_a : met->along_b;
      sensed.along_x = static_cast<float>(along.x());
      sensed.along_y = static_cast<float>(along.y());
      sensed.opening = static_cast<float>(is_from_a ? turned(a, b) : turned(b, a));
      sensed.end_share =
          static_cast<float>((is_from_a ? square_b : square_a) / (square_a + square_b));
      sensed.arm_m = std::sqrt(std::min(square_a, square_b));
      sensed.gap_m = met->gap_m;
      sensed_.push_back(sensed);
    }
  }
}

/// What a corner of the plan must be like to be taken for one of the scan.
CornerIndex::Likeness CornerSearch::likeness(const Sensed& sensed) const {
  return {static_cast<double>(sensed.opening), options_.tolerance_rad,
          sensed.gap_m + options_.gap_slack_m};
}

/// Those of the longest walls that come nearest to each other, as many as the plan's size allows.
void CornerSearch::choose_corners(const CornerIndex& corners) {
  std::stable_sort(sensed_.begin(), sensed_.end(), [](const Sensed& a, const Sensed& b) {
    return a.arm_m - a.gap_m > b.arm_m - b.gap_m;
  });
  const auto fewest = count_of(options_.fewest);
  const auto most = count_of(options_.most);
  std::size_t pairs = 0;
  std::size_t kept = 0;
  for (; kept < std::min(sensed_.size(), most); ++kept) {
    corners.visit(likeness(sensed_[kept]),
                  [&](std::size_t, std::span<const Sector> like) { pairs += like.size(); });
    if (kept >= fewest && static_cast<double>(pairs) > options_.most_pairs) break;
  }
  sensed_.resize(kept);
}

/// The pose that takes a corner of the scan onto one of the plan, both walls as near as they can
/// be: the little by which the plan's opens wider is shared by the length of the walls.
QuickFit::Placed CornerSearch::place(const Sensed& sensed, const Sector& sector) {
  const float wider = sensed.end_share * (sector.opening - sensed.opening);
  const float c = 1.0F - 0.5F * wider * wider;  // a small angle's, its sine too
  const float s = wider - wider * wider * wider / 6.0F;
  const float straight_c = sector.along_x * sensed.along_x + sector.along_y * sensed.along_y;
  const float straight_s = sector.along_y * sensed.along_x - sector.along_x * sensed.along_y;
  QuickFit::Placed at;
  at.cosine = straight_c * c - straight_s * s;
  at.sine = straight_s * c + straight_c * s;
  at.x = sector.x - (at.cosine * sensed.x - at.sine * sensed.y);
  at.y = sector.y - (at.sine * sensed.x + at.cosine * sensed.y);
  return at;
}

/// In the map.
static Pose2 in_map(const QuickFit::Placed& at, const Vector2d& origin) {
  return {origin.x() + static_cast<double>(at.x), origin.y() + static_cast<double>(at.y),
          std::atan2(static_cast<double>(at.sine), static_cast<double>(at.cosine))};
}

/// The lowest of the highest ratings, so many or a few more.
static std::size_t lowest_of(const std::vector<std::uint8_t>& ratings, std::size_t most) {
  std::array<std::size_t, 256> counts{};
  for (const std::uint8_t rating : ratings) ++counts[rating];
  std::size_t lowest = 255;
  std::size_t sum = 0;
  while (lowest > 0 && (sum += counts[lowest]) < most) --lowest;
  return lowest;
}

/// Calls `each(sensed, number of the sector, sector)` for all pairs that are alike.
template <class Each>
void CornerSearch::for_each_pair(const CornerIndex& corners, const Each& each) const {
  for (std::uint32_t s = 0; s < sensed_.size(); ++s) {
    corners.visit(likeness(sensed_[s]), [&](std::size_t first, std::span<const Sector> like) {
      for (std::size_t i = 0; i < like.size(); ++i) each(s, first + i, like[i]);
    });
  }
}

/// All pairs roughly, and the best of them again.
void CornerSearch::rate(const PlaceIndex& index, const std::optional<SearchArea>& area) {
  ratings_.clear();
  const WallField& walls = index.walls();
  const auto sigma = static_cast<float>(options_.sigma_m);
  const auto weights = QuickFit::off_weights(sigma);
  for_each_pair(index.corners(), [&](std::uint32_t s, std::size_t, const Sector& sector) {
    const QuickFit::Placed at = place(sensed_[s], sector);
    const bool is_asked = !area || area->holds(in_map(at, walls.origin()).translation());
    const float agreement = is_asked ? few_returns_.rough_agreement(walls, at, weights) : 0.0F;
    ratings_.push_back(static_cast<std::uint8_t>(kFullRating * agreement));
  });
  const std::size_t lowest = std::max<std::size_t>(
      1,
      lowest_of(ratings_, part_of(ratings_.size(), options_.rated_share, options_.fewest_rated)));
  std::size_t pair = 0;
  for_each_pair(index.corners(), [&](std::uint32_t s, std::size_t, const Sector& sector) {
    std::uint8_t& rating = ratings_[pair++];
    const bool is_asked = rating >= lowest;
    rating = 0;
    if (!is_asked) return;
    const QuickFit::Placed at = place(sensed_[s], sector);
    const float agreement = few_returns_.agreement(walls, at, sigma);
    rating = static_cast<std::uint8_t>(kFullRating * agreement);
  });
}

/// The best rated, one of each cell: the corners of one place say the same.
std::span<const PlaceMatch> CornerSearch::take(const PlaceIndex& index, std::size_t most) {
  found_.clear();
  const std::size_t worst = std::max<std::size_t>(1, lowest_of(ratings_, 8 * most));
  ranked_.clear();
  std::size_t pair = 0;
  for_each_pair(index.corners(), [&](std::uint32_t s, std::size_t i, const Sector&) {
    const std::uint8_t rating = ratings_[pair++];
    if (rating >= worst) ranked_.push_back({rating, s, static_cast<std::uint32_t>(i)});
  });
  std::stable_sort(ranked_.begin(), ranked_.end(),
                   [](const Ranked& a, const Ranked& b) { return a.rating > b.rating; });
  keep_one_of_each_cell(index, most);
  // In the order of the plan, not of the ratings: what is near is looked up together.
  std::sort(ranked_.begin(), ranked_.end(), [](const Ranked& a, const Ranked& b) {
    return std::tie(a.sensed, a.sector) < std::tie(b.sensed, b.sector);
  });
  for (const Ranked& ranked : ranked_) {
    found_.push_back({pose_of(ranked, index), 0, 0.0F, 0.0F});
  }
  return found_;
}

/// Of the ranked pairs no more than so many, those first that come first.
void CornerSearch::keep_one_of_each_cell(const PlaceIndex& index, std::size_t most) {
  cells_.clear(ranked_.size(), options_.cell_m, options_.cell_rad);
  std::size_t kept = 0;
  for (const Ranked& ranked : ranked_) {
    if (kept >= most) break;
    if (cells_.insert(pose_of(ranked, index))) ranked_[kept++] = ranked;
  }
  ranked_.resize(kept);
}

Pose2 CornerSearch::pose_of(const Ranked& ranked, const PlaceIndex& index) const {
  const Sector& sector = index.corners().sector(ranked.sector);
  return in_map(place(sensed_[ranked.sensed], sector), index.walls().origin());
}

}  // namespace adit
