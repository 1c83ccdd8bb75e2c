#include "adit/survey/station_headings.hpp"

#include <algorithm>
#include <cmath>

namespace adit {
namespace {

constexpr double kApart = radians(10.0);  // candidates nearer than this are one
constexpr double kStill = radians(0.01);  // a sweep that turns no station more is the last
constexpr double kFinestStep = radians(0.05);
constexpr double kOtherStep = radians(0.25);
constexpr std::size_t kOthers = 4;        // headings of each station that are tried again
constexpr int kMostTrials = 4;            // of them; a heading that turns may turn others
constexpr std::size_t kMostPoints = 500;  // of a station: more cost time and tell little more
constexpr std::size_t kFewPoints = 120;   // enough to try a heading

/// So many of the points, evenly.
std::vector<StationPoint> at_most(std::size_t count, const std::vector<StationPoint>& points) {
  if (points.size() <= count) return points;
  std::vector<StationPoint> some;
  for (std::size_t i = 0; i < count; ++i) some.push_back(points[i * points.size() / count]);
  return some;
}

/// The heading in [from, to] with the highest score, by steps, then between the steps.
template <class Score>
std::pair<double, double> best_heading(double from, double to, double step, const Score& score) {
  const int count = std::max(2, static_cast<int>(std::ceil((to - from) / step)));
  const double exact = (to - from) / count;
  std::vector<double> scores;
  for (int i = 0; i <= count; ++i) scores.push_back(score(from + i * exact));
  const auto best = std::max_element(scores.begin(), scores.end()) - scores.begin();
  double at = from + static_cast<double>(best) * exact;
  if (best > 0 && best < count) {
    const double left = scores[static_cast<std::size_t>(best) - 1];
    const double right = scores[static_cast<std::size_t>(best) + 1];
    const double middle = scores[static_cast<std::size_t>(best)];
    const double bend = left - 2.0 * middle + right;
    if (bend < 0.0) at += 0.5 * exact * (left - right) / bend;
  }
  return {at, scores[static_cast<std::size_t>(best)]};
}

/// The first of the headings in order of their scores, each so far from those before.
std::vector<double> apart_by(double apart, std::span<const std::pair<double, double>> scored,
                             std::size_t most) {
  std::vector<double> chosen;
  for (const auto& [score, heading] : scored) {
    const bool known = std::any_of(chosen.begin(), chosen.end(), [&, h = heading](double c) {
      return std::abs(angle_between(c, h)) < apart;
    });
    if (!known) chosen.push_back(heading);
    if (chosen.size() == most) break;
  }
  return chosen;
}

class HeadingSearch {
 public:
  HeadingSearch(std::span<const StationView> stations, const HeadingOptions& options)
      : stations_(stations), options_(options) {
    for (const StationView& s : stations) {
      points_.push_back(at_most(kMostPoints, thin_points(s.points, options.point_spacing_m)));
      sparse_.push_back(at_most(kFewPoints, points_.back()));
      sure_.push_back(points_.back());
      std::erase_if(sure_.back(), [&](const StationPoint& p) {
        return p.point.norm() > s.sure_range_m ||
               s.sight.share_seen_through({&p, 1}, {}, 0.5 * options.through_m) > 0.0;
      });
    }
    blur(options.coarse_blur_m);
    for (std::size_t i = 0; i < stations.size(); ++i) neighbours_.push_back(neighbours_of(i));
  }

  std::vector<StationHeading> search() {
    const std::size_t first = best_connected();
    std::vector<double> best;
    double most = -1.0;
    for (const double candidate : first_headings(first)) {
      std::vector<double> headings = grow(first, candidate);
      sweep(headings, 2.0 * options_.coarse_step_rad, 0.5 * options_.coarse_step_rad, sparse_);
      const double total = total_score(headings);
      if (total <= most) continue;
      most = total;
      best = headings;
    }
    for (int i = 0; i < 3; ++i) {
      sweep(best, options_.coarse_step_rad, 0.25 * options_.coarse_step_rad, points_);
    }
    const auto others = other_headings(best);
    blur(options_.fine_blur_m);
    bool changed = true;
    for (int i = 0; i < options_.sweeps; ++i) {
      if (i > 0 && i <= kMostTrials && changed) changed = try_others(others, best);
      const double reach = i < 2 ? radians(1.5) : radians(0.5);
      if (sweep(best, reach, i < 2 ? radians(0.25) : 2.0 * kFinestStep, points_) < kStill) break;
    }
    return report(best);
  }

 private:
  using Points = std::vector<std::vector<StationPoint>>;

  void blur(double blur_m) {
    fields_.clear();
    for (const StationView& s : stations_) {
      fields_.emplace_back(thin_points(s.points, 0.5 * blur_m), blur_m);
    }
  }

  double apart(std::size_t i, std::size_t j) const {
    return (stations_[i].position - stations_[j].position).norm();
  }

  /// The nearest half, and the other half spread over those in reach: long baselines tell headings
  /// best.
  std::vector<std::size_t> neighbours_of(std::size_t i) const {
    std::vector<std::size_t> all;
    for (std::size_t j = 0; j < stations_.size(); ++j) {
      if (j != i && apart(i, j) <= options_.reach_m && !points_[j].empty()) all.push_back(j);
    }
    std::stable_sort(all.begin(), all.end(),
                     [&](std::size_t a, std::size_t b) { return apart(i, a) < apart(i, b); });
    const auto wanted = static_cast<std::size_t>(std::max(1, options_.neighbours));
    if (all.size() <= wanted) return all;
    const std::size_t near = (wanted + 1) / 2;
    std::vector<std::size_t> chosen(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(near));
    for (std::size_t k = near; k < wanted; ++k) {
      chosen.push_back(all[near + (k - near + 1) * (all.size() - near - 1) / (wanted - near)]);
    }
    return chosen;
  }

  std::size_t best_connected() const {
    std::size_t best = 0;
    double least = 1e300;
    for (std::size_t i = 0; i < stations_.size(); ++i) {
      if (neighbours_[i].empty()) continue;
      double sum = 0.0;
      for (const std::size_t j : neighbours_[i]) sum += apart(i, j);
      const double mean = sum / static_cast<double>(neighbours_[i].size()) -
                          0.01 * static_cast<double>(points_[i].size());
      if (mean < least) {
        least = mean;
        best = i;
      }
    }
    return best;
  }

  Pose2 pose_of(std::size_t i, double heading) const {
    return {stations_[i].position.x(), stations_[i].position.y(), heading};
  }

  /// How well what i saw agrees with what j saw.
  double agreement(std::size_t i, double heading_i, std::size_t j, double heading_j,
                   const Points& points) {
    return fields_[j].mean_agreement(points[i],
                                     inverse(pose_of(j, heading_j)) * pose_of(i, heading_i));
  }

  std::pair<double, double> bounds(std::size_t i) const {
    const auto& given = stations_[i].heading;
    if (!given) return {-kPi, kPi};
    return {*given - options_.given_within_rad, *given + options_.given_within_rad};
  }

  /// So far round a heading, as far as the bounds of one that was given go.
  std::pair<double, double> around(std::size_t i, double heading, double reach) const {
    if (!stations_[i].heading) return {heading - reach, heading + reach};
    const auto [from, to] = bounds(i);
    return {std::clamp(heading - reach, from, to), std::clamp(heading + reach, from, to)};
  }

  /// Headings of the first station under which its neighbours can agree with it, best first.
  std::vector<double> first_headings(std::size_t first) {
    const auto [from, to] = bounds(first);
    std::vector<std::pair<double, double>> scored;
    const auto& near = neighbours_[first];
    for (double heading = from; heading < to; heading += options_.coarse_step_rad) {
      double sum = 0.0;
      for (std::size_t k = 0; k < std::min<std::size_t>(near.size(), 4); ++k) {
        const auto [low, high] = bounds(near[k]);
        sum += best_heading(low, high, options_.coarse_step_rad, [&](double other) {
                 return agreement(near[k], other, first, heading, sparse_);
               }).second;
      }
      scored.emplace_back(-sum, heading);
    }
    std::sort(scored.begin(), scored.end());
    return apart_by(kApart, scored, static_cast<std::size_t>(std::max(1, options_.candidates)));
  }

  /// From the first station outwards, the nearest first, each against those that are placed.
  std::vector<double> grow(std::size_t first, double heading) {
    std::vector<double> headings(stations_.size(), 0.0);
    std::vector<char> placed(stations_.size(), 0);
    std::vector<double> away(stations_.size(), 1e300);  // from the nearest that is placed (m)
    std::size_t next = first;
    headings[first] = heading;
    for (std::size_t round = 1; round < stations_.size(); ++round) {
      placed[next] = 1;
      std::size_t nearest = next;
      double least = 1e300;
      for (std::size_t i = 0; i < stations_.size(); ++i) {
        if (placed[i] != 0) continue;
        away[i] = std::min(away[i], apart(i, next));
        if (away[i] >= least) continue;
        least = away[i];
        nearest = i;
      }
      next = nearest;
      headings[next] = place(next, headings, placed);
    }
    return headings;
  }

  double place(std::size_t i, const std::vector<double>& headings,
               const std::vector<char>& placed) {
    std::vector<std::size_t> near;
    for (std::size_t j = 0; j < stations_.size(); ++j) {
      if (placed[j] != 0) near.push_back(j);
    }
    std::stable_sort(near.begin(), near.end(),
                     [&](std::size_t a, std::size_t b) { return apart(i, a) < apart(i, b); });
    near.resize(std::min<std::size_t>(near.size(), 4));
    const auto [from, to] = bounds(i);
    return best_heading(from, to, options_.coarse_step_rad,
                        [&](double h) {
                          double sum = 0.0;
                          for (const std::size_t j : near)
                            sum += agreement(i, h, j, headings[j], sparse_);
                          return sum;
                        })
        .first;
  }

  /// One round over all stations, each against its neighbours; the largest turn (rad).
  double sweep(std::vector<double>& headings, double reach, double step, const Points& points) {
    double largest = 0.0;
    for (std::size_t i = 0; i < stations_.size(); ++i) {
      if (neighbours_[i].empty()) continue;
      const double before = headings[i];
      const auto [from, to] = around(i, before, reach);
      headings[i] = best_heading(from, to, step, [&](double h) {
                      double sum = 0.0;
                      for (const std::size_t j : neighbours_[i]) {
                        sum += agreement(i, h, j, headings[j], points);
                      }
                      return sum;
                    }).first;
      largest = std::max(largest, std::abs(headings[i] - before));
    }
    return largest;
  }

  /// Headings all round the circle under which each station agrees with the others too, with the
  /// blurred fields: an entry looks much alike forwards and backwards.
  std::vector<std::vector<double>> other_headings(const std::vector<double>& headings) {
    std::vector<std::vector<double>> others(stations_.size());
    for (std::size_t i = 0; i < stations_.size(); ++i) {
      const auto [from, to] = bounds(i);
      std::vector<std::pair<double, double>> scored;
      for (double h = from; h < to; h += options_.coarse_step_rad) {
        scored.emplace_back(-agreement_of(i, headings, h - headings[i]), h);
      }
      std::sort(scored.begin(), scored.end());
      others[i] = apart_by(kApart, scored, kOthers);
      if (!stations_[i].heading) others[i].push_back(headings[i] + kPi);
    }
    return others;
  }

  /// Takes another heading of a station where the sharp fields and what was open like it better;
  /// whether any was taken.
  bool try_others(const std::vector<std::vector<double>>& others, std::vector<double>& headings) {
    bool changed = false;
    for (std::size_t i = 0; i < stations_.size(); ++i) {
      const double reach = options_.coarse_step_rad;
      double best = headings[i];
      double most = score_of(i, headings, best);
      for (const double other : others[i]) {
        const auto [from, to] = around(i, other, reach);
        const double heading = best_heading(from, to, kOtherStep, [&](double h) {
                                 return agreement_of(i, headings, h - headings[i]);
                               }).first;
        if (std::abs(angle_between(heading, headings[i])) < reach) continue;
        const double score = score_of(i, headings, heading);
        if (score <= most) continue;
        most = score;
        best = heading;
        changed = true;
      }
      headings[i] = best;
    }
    return changed;
  }

  /// Agreement with the neighbours, less by the share of it that is contradicted: where agreement
  /// is rare, clutter that was seen through must not outweigh it.
  double score_of(std::size_t i, const std::vector<double>& headings, double heading) {
    const double contradicted = options_.against * contradiction_of(i, headings, heading);
    return agreement_of(i, headings, heading - headings[i]) * std::exp(-contradicted);
  }

  /// Share of surfaces that one station saw and another's beams went through.
  double contradiction_of(std::size_t i, const std::vector<double>& headings,
                          double heading) const {
    double sum = 0.0;
    const Pose2 map_from_i = pose_of(i, heading);
    for (const std::size_t j : neighbours_[i]) {
      const Pose2 i_from_j = inverse(map_from_i) * pose_of(j, headings[j]);
      sum += stations_[i].sight.share_seen_through(sure_[j], i_from_j, options_.through_m) +
             stations_[j].sight.share_seen_through(sure_[i], inverse(i_from_j), options_.through_m);
    }
    return neighbours_[i].empty() ? 0.0 : 0.5 * sum / static_cast<double>(neighbours_[i].size());
  }

  double agreement_of(std::size_t i, const std::vector<double>& headings, double turn) {
    double sum = 0.0;
    for (const std::size_t j : neighbours_[i]) {
      sum += agreement(i, headings[i] + turn, j, headings[j], points_);
    }
    return neighbours_[i].empty() ? 0.0 : sum / static_cast<double>(neighbours_[i].size());
  }

  double total_score(const std::vector<double>& headings) {
    double sum = 0.0;
    for (std::size_t i = 0; i < stations_.size(); ++i) sum += score_of(i, headings, headings[i]);
    return sum;
  }

  std::vector<StationHeading> report(const std::vector<double>& headings) {
    std::vector<StationHeading> out;
    for (std::size_t i = 0; i < stations_.size(); ++i) {
      const double middle = agreement_of(i, headings, 0.0);
      const double step = radians(1.0);
      const double sides =
          0.5 * (agreement_of(i, headings, step) + agreement_of(i, headings, -step));
      // The agreement falls like a bell as wide as the blur at the points' distance; its middle is
      // known to that width over the root of the points.
      const double bend = std::max(1e-9, (middle - sides) / std::max(middle, 1e-9));
      const double width = step / std::sqrt(2.0 * bend);
      const auto count = static_cast<double>(std::max<std::size_t>(points_[i].size(), 1));
      out.push_back({wrap_angle(headings[i]), middle, std::min(kPi, width / std::sqrt(count)),
                     contradiction_of(i, headings, headings[i])});
    }
    return out;
  }

  std::span<const StationView> stations_;
  const HeadingOptions& options_;
  Points points_;
  Points sparse_;
  Points sure_;  // those that are neither roof nor floor and that do not move
  std::vector<StationField> fields_;
  std::vector<std::vector<std::size_t>> neighbours_;
};

}  // namespace

std::vector<StationHeading> find_headings(std::span<const StationView> stations,
                                          const HeadingOptions& options) {
  if (stations.empty()) return {};
  if (stations.size() == 1) return {{stations[0].heading.value_or(0.0), 0.0, kPi}};
  return HeadingSearch(stations, options).search();
}

double find_turn(std::span<const StationPoint> points, StationField& field, double from, double to,
                 double step) {
  return best_heading(from, to, step,
                      [&](double turn) {
                        return field.mean_agreement(points, {0.0, 0.0, turn});
                      })
      .first;
}

}  // namespace adit
