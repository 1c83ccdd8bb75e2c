#include "adit/evaluation/relations.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace adit {
namespace {

struct Moments {
  double mean = RelationsMetric::kNone;
  double deviation = RelationsMetric::kNone;
};

Moments moments(const std::vector<double>& values) {
  if (values.empty()) return {};
  const auto count = static_cast<double>(values.size());
  double sum = 0.0;
  for (const double value : values) sum += value;
  const double mean = sum / count;
  double squares = 0.0;
  for (const double value : values) squares += (value - mean) * (value - mean);
  return {mean, std::sqrt(squares / count)};
}

}  // namespace

RelationsMetric relations_metric(std::span<const EstimateSample> estimates,
                                 std::span<const Relation> relations, double join_tolerance_s) {
  constexpr double kInfinite = std::numeric_limits<double>::infinity();
  const StampIndex index(stamps_of(estimates));
  std::vector<double> translations;
  std::vector<double> squares;
  std::vector<double> rotations_deg;
  for (const Relation& relation : relations) {
    const auto from = index.nearest(relation.from_stamp, join_tolerance_s);
    const auto to = index.nearest(relation.to_stamp, join_tolerance_s);
    if (!from || !to) continue;
    const Pose2 estimated = inverse(estimates[*from].pose) * estimates[*to].pose;
    const Pose2 error = inverse(relation.from_to) * estimated;
    const double translation = error.is_finite() ? error.translation().norm() : kInfinite;
    translations.push_back(translation);
    squares.push_back(translation * translation);
    rotations_deg.push_back(error.is_finite() ? degrees(std::abs(error.theta)) : kInfinite);
  }

  RelationsMetric metric;
  metric.count = static_cast<std::int64_t>(relations.size());
  metric.matched = static_cast<std::int64_t>(translations.size());
  const Moments translation = moments(translations);
  const Moments squared = moments(squares);
  const Moments rotation = moments(rotations_deg);
  metric.translation_mean = translation.mean;
  metric.translation_std = translation.deviation;
  metric.translation_squared_mean = squared.mean;
  metric.translation_squared_std = squared.deviation;
  metric.rotation_mean_deg = rotation.mean;
  metric.rotation_std_deg = rotation.deviation;
  if (!translations.empty()) {
    metric.translation_max = *std::max_element(translations.begin(), translations.end());
    metric.rotation_max_deg = *std::max_element(rotations_deg.begin(), rotations_deg.end());
  }
  return metric;
}

}  // namespace adit
