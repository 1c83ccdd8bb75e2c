#include "adit/matching/candidates.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "adit/matching/unary.hpp"

namespace adit {
namespace {

// A model feature just across the seam at +-pi counts as one lap further or back.
int unwrapped_rank(double sensed_azimuth, double model_azimuth, int rank, int laps_of) {
  const double difference = model_azimuth - sensed_azimuth;
  if (difference > kPi) return rank - laps_of;
  return difference <= -kPi ? rank + laps_of : rank;
}

// Weighs the pair's own turn with the prior, which expects none within angerr.
void expect_heading(const MatchingOptions& options, Candidate& pair) {
  const double prior = options.angerr * options.angerr;
  const double gain = pair.has_turn && prior > 0.0 ? prior / (prior + pair.turn_noise) : 0.0;
  pair.heading = gain * pair.turn;
  pair.heading_noise = pair.has_turn ? gain * pair.turn_noise : prior;
}

Candidate corner_candidate(const CornerView& sensed, const CornerView& model,
                           const MatchingOptions& options) {
  Candidate pair;
  pair.kind = FeatureKind::corner;
  pair.sensed_rank = sensed.rank;
  if (sensed.corner->bisector && model.corner->bisector) {
    pair.has_turn = true;
    pair.turn = turn_between(*model.corner->bisector, *sensed.corner->bisector);
    pair.turn_noise =
        noise_factor(options) * sensed.corner->bisector_sigma * sensed.corner->bisector_sigma;
  }
  expect_heading(options, pair);
  return pair;
}

Candidate line_candidate(const LineView& sensed, const LineView& model,
                         const MatchingOptions& options) {
  Candidate pair;
  pair.kind = FeatureKind::line;
  pair.sensed_rank = sensed.rank;
  pair.has_turn = true;
  pair.turn = turn_between(model.line->orientation, sensed.line->orientation);
  pair.turn_noise = sensed.orientation_noise;
  pair.shift = sensed.line->distance - model.line->distance;
  const SlideRange slides = allowed_slides(sensed, model, options);
  pair.slide_low = slides.low;
  pair.slide_high = slides.high;
  expect_heading(options, pair);
  return pair;
}

void add_corner(int place, const FeatureViews& sensed_views, const FeatureViews& model_views,
                const MatchingOptions& options, std::vector<Candidate>& pairs) {
  const CornerView& sensed = sensed_views.corners[static_cast<std::size_t>(place)];
  const int laps_of = static_cast<int>(model_views.order.size());
  for (std::size_t m = 0; m < model_views.corners.size(); ++m) {
    const CornerView& model = model_views.corners[m];
    if (!corners_may_match(sensed, *sensed_views.features, model, *model_views.features, options)) {
      continue;
    }
    Candidate pair = corner_candidate(sensed, model, options);
    pair.sensed = place;
    pair.model = static_cast<int>(m);
    pair.model_rank = unwrapped_rank(sensed.azimuth, model.azimuth, model.rank, laps_of);
    pairs.push_back(pair);
  }
}

void add_line(int place, const FeatureViews& sensed_views, const FeatureViews& model_views,
              const MatchingOptions& options, std::vector<Candidate>& pairs) {
  const LineView& sensed = sensed_views.lines[static_cast<std::size_t>(place)];
  const int laps_of = static_cast<int>(model_views.order.size());
  for (std::size_t m = 0; m < model_views.lines.size(); ++m) {
    const LineView& model = model_views.lines[m];
    if (!lines_may_match(sensed, model, options)) continue;
    Candidate pair = line_candidate(sensed, model, options);
    pair.sensed = place;
    pair.model = static_cast<int>(m);
    pair.model_rank = unwrapped_rank(sensed.azimuth, model.azimuth, model.rank, laps_of);
    pairs.push_back(pair);
  }
}

int points_of(const Candidate& pair, const FeatureViews& sensed) {
  const auto place = static_cast<std::size_t>(pair.sensed);
  return pair.kind == FeatureKind::corner ? sensed.corners[place].corner->points
                                          : sensed.lines[place].line->points;
}

// Keeps the pairs of the best supported sensed features, in their order.
void truncate(const FeatureViews& sensed, int limit, CandidateList& list) {
  auto& pairs = list.pairs;
  if (static_cast<int>(pairs.size()) <= limit) return;
  list.truncated = true;
  list.buffer.resize(pairs.size());
  std::iota(list.buffer.begin(), list.buffer.end(), 0);
  std::nth_element(list.buffer.begin(), list.buffer.begin() + limit, list.buffer.end(),
                   [&](int a, int b) {
                     const int points_a = points_of(pairs[static_cast<std::size_t>(a)], sensed);
                     const int points_b = points_of(pairs[static_cast<std::size_t>(b)], sensed);
                     return points_a != points_b ? points_a > points_b : a < b;
                   });
  list.buffer.resize(static_cast<std::size_t>(limit));
  std::sort(list.buffer.begin(), list.buffer.end());
  std::size_t kept = 0;
  for (const int index : list.buffer) pairs[kept++] = pairs[static_cast<std::size_t>(index)];
  pairs.resize(kept);
}

void group_by_sensed(CandidateList& list) {
  const int count = static_cast<int>(list.pairs.size());
  for (int first = 0; first < count;) {
    const int rank = list.pairs[static_cast<std::size_t>(first)].sensed_rank;
    int last = first + 1;
    while (last < count && list.pairs[static_cast<std::size_t>(last)].sensed_rank == rank) ++last;
    list.groups.emplace_back(first, last);
    first = last;
  }
}

}  // namespace

void find_candidates(const FeatureViews& sensed, const FeatureViews& model,
                     const MatchingOptions& options, CandidateList& out) {
  out.pairs.clear();
  out.groups.clear();
  out.truncated = false;
  for (const FeatureRef& ref : sensed.order) {
    const auto first = static_cast<std::ptrdiff_t>(out.pairs.size());
    if (ref.kind == FeatureKind::corner) {
      add_corner(ref.index, sensed, model, options, out.pairs);
    } else {
      add_line(ref.index, sensed, model, options, out.pairs);
    }
    std::sort(out.pairs.begin() + first, out.pairs.end(),
              [](const Candidate& a, const Candidate& b) { return a.model_rank < b.model_rank; });
  }
  truncate(sensed, std::max(0, options.max_candidates), out);
  group_by_sensed(out);
}

}  // namespace adit
