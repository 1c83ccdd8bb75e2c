#include "alias_survey.hpp"

#include <fmt/core.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>

#include "adit/plot/figures.hpp"
#include "adit/refinement/map_error.hpp"
#include "adit/threads/share_out.hpp"
#include "adit/visibility/visibility.hpp"
#include "progress.hpp"

namespace adit {
namespace {

ScannerSpec without_noise(ScannerSpec scanner) {
  scanner.model.range_sigma_m = 0.0;
  scanner.model.quantisation_m = 0.0;
  scanner.model.bearing_sigma_rad = 0.0;
  scanner.dropout_ratio = 0.0;
  scanner.dust_ratio = 0.0;
  return scanner;
}

bool is_same(const Pose2& a, const Pose2& b, const RelocationOptions& options) {
  return is_near(a, b, options.apart_m, options.apart_rad);
}

/// Whether the truth is within what the answer leaves open.
bool fits(const RankedPose& answer, const Pose2& truth, const AliasOptions& options) {
  const Vector3d apart = difference(answer.pose, truth);
  return apart.dot(answer.covariance.ldlt().solve(apart)) < options.open_chi_square;
}

/// Whether two pairs are of the same two places, whichever comes first.
bool is_pair_again(const Alias& a, const Alias& b, double near_m) {
  const auto close = [&](const Pose2& p, const Pose2& q) {
    return (p.translation() - q.translation()).norm() < near_m;
  };
  return (close(a.pose, b.pose) && close(a.other, b.other)) ||
         (close(a.pose, b.other) && close(a.other, b.pose));
}

/// The pairs of most weight, each of other places.
std::vector<Alias> worst_of(std::vector<Alias> aliases, std::size_t most, double near_m) {
  std::stable_sort(aliases.begin(), aliases.end(),
                   [](const Alias& a, const Alias& b) { return a.weight > b.weight; });
  std::vector<Alias> worst;
  for (const Alias& alias : aliases) {
    if (worst.size() >= most) break;
    const bool again = std::any_of(worst.begin(), worst.end(), [&](const Alias& listed) {
      return is_pair_again(listed, alias, near_m);
    });
    if (!again) worst.push_back(alias);
  }
  return worst;
}

std::string pose_text(const Pose2& pose) {
  return fmt::format("{:>9.2f} {:>9.2f} {:>7.1f}", pose.x, pose.y, degrees(pose.theta));
}

}  // namespace

AliasSurveyor::AliasSurveyor(const LineMap& map, const PlaceIndex& index,
                             const ScannerSpec& scanner, const LocalizerSettings& settings)
    : map_(map),
      index_(index),
      scanner_(without_noise(scanner)),
      settings_(settings),
      caster_(plan_of(map)) {}

/// The heading along the farthest view: that of the opening, where there is one.
Pose2 AliasSurveyor::pose_at(const Vector2d& place) const {
  constexpr std::size_t kRays = 360;
  constexpr double kStep = kTwoPi / static_cast<double>(kRays);
  std::array<double, kRays> ranges{};
  Visibility visibility;
  visibility.sweep(map_, place, settings_.scanner.max_range_m);
  visibility.ranges(-kPi, kStep, ranges);
  for (double& range : ranges) {
    if (!std::isfinite(range)) range = 0.0;  // no view, but a gap in the plan
  }
  const auto farthest = std::max_element(ranges.begin(), ranges.end()) - ranges.begin();
  return {place.x(), place.y(), wrap_angle(-kPi + kStep * static_cast<double>(farthest))};
}

SurveyedPlace AliasSurveyor::judge(const Pose2& truth, const RelocationResult& found,
                                   const AliasOptions& options, std::vector<Alias>& aliases) const {
  SurveyedPlace place{truth.translation(), PlaceAnswer::lost, 0};
  if (found.verdict == Status::lost) return place;
  const RankedPose& best = found.poses.front();
  const bool is_open = found.verdict == Status::degraded && fits(best, truth, options);
  const bool is_right = is_open || is_same(truth, best.pose, settings_.relocation);
  std::vector<Pose2> apart{truth};
  if (is_right) apart.push_back(best.pose);
  for (const RankedPose& pose : found.poses) {
    const bool is_known = std::any_of(apart.begin(), apart.end(), [&](const Pose2& known) {
      return is_same(known, pose.pose, settings_.relocation);
    });
    if (is_known || pose.weight < options.least_weight) continue;
    apart.push_back(pose.pose);
    aliases.push_back({truth, pose.pose, pose.weight});
  }
  place.poses = static_cast<int>(apart.size()) - (is_right ? 1 : 0);
  if (found.verdict == Status::ambiguous) {
    place.answer = PlaceAnswer::ambiguous;
  } else if (!is_right) {
    place.answer = PlaceAnswer::wrong;
  } else {
    place.answer = found.verdict == Status::ok ? PlaceAnswer::unique : PlaceAnswer::open;
  }
  return place;
}

AliasSurvey AliasSurveyor::survey(std::span<const Vector2d> places, int threads,
                                  const AliasOptions& options) const {
  AliasSurvey survey;
  survey.places.resize(places.size());
  std::vector<std::vector<Alias>> aliases(places.size());
  const MapError map_error = MapErrorEstimator(settings_.map).error();
  constexpr std::size_t kAtOnce = 8;  // places a thread, between two steps of the progress
  Progress progress("looking around", places.size());
  for (std::size_t begin = 0; begin < places.size();) {
    const std::size_t count =
        std::min(kAtOnce * static_cast<std::size_t>(threads), places.size() - begin);
    share_out(count, threads, [&] {
      return [&, relocator = Relocator(map_, index_)](std::size_t k) mutable {
        const std::size_t i = begin + k;
        const Pose2 truth = pose_at(places[i]);
        Random no_noise(0);
        const LaserScan scan = simulate_scan(caster_, truth, scanner_, no_noise);
        const RelocationResult& found = relocator.locate(
            {scan, settings_.scanner, map_error, std::nullopt, std::nullopt}, settings_.relocation,
            settings_.likelihood, settings_.refinement, settings_.status);
        survey.places[i] = judge(truth, found, options, aliases[i]);
      };
    });
    begin += count;
    for (std::size_t i = 0; i < count; ++i) progress.advance();
  }
  for (const std::vector<Alias>& of_place : aliases) {
    survey.aliases.insert(survey.aliases.end(), of_place.begin(), of_place.end());
  }
  return survey;
}

std::string alias_summary(const AliasSurvey& survey, double pitch_m, const AliasOptions& options) {
  std::string text = fmt::format("{} places, {:.2f} m apart\n", survey.places.size(), pitch_m);
  for (std::size_t k = 0; k < kPlaceAnswers; ++k) {
    const auto answer = static_cast<PlaceAnswer>(k);
    const auto count =
        std::count_if(survey.places.begin(), survey.places.end(),
                      [&](const SurveyedPlace& place) { return place.answer == answer; });
    const double all = static_cast<double>(std::max<std::size_t>(1, survey.places.size()));
    text += fmt::format("{:>7} {:>6.1f} %  {}\n", count, 100.0 * static_cast<double>(count) / all,
                        to_string(answer));
  }
  const std::vector<Alias> worst = worst_of(survey.aliases, options.worst_pairs, 2.0 * pitch_m);
  if (worst.empty()) return text;
  text += fmt::format("the worst pairs ({} in all):\n", survey.aliases.size());
  text += fmt::format("{:>9} {:>9} {:>7}   {:>9} {:>9} {:>7}  {:>7}\n", "x [m]", "y [m]", "deg",
                      "x [m]", "y [m]", "deg", "weight");
  for (const Alias& alias : worst) {
    text += fmt::format("{}   {}  {:>7.3f}\n", pose_text(alias.pose), pose_text(alias.other),
                        alias.weight);
  }
  return text;
}

}  // namespace adit
