#pragma once

#include <cstdint>
#include <span>

#include "adit/evaluation/join.hpp"
#include "adit/evaluation/sample.hpp"
#include "adit/geometry/pose2.hpp"

namespace adit {

/// A verified relative pose: where the vehicle stood at `to_stamp`, seen from where it stood at
/// `from_stamp`.
struct Relation {
  double from_stamp = 0.0;
  double to_stamp = 0.0;
  Pose2 from_to;
};

/// The error of a trajectory's own relative poses against verified ones (Kümmerle et al. 2009, eq.
/// 2 and 3): metres, and degrees of the absolute turn. Figures without data are not-a-number.
struct RelationsMetric {
  static constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  std::int64_t count = 0;    ///< relations given
  std::int64_t matched = 0;  ///< of these, with an estimate at both stamps
  double translation_mean = kNone;
  double translation_std = kNone;  ///< of the population
  double translation_squared_mean = kNone;
  double translation_squared_std = kNone;
  double translation_max = kNone;
  double rotation_mean_deg = kNone;
  double rotation_std_deg = kNone;
  double rotation_max_deg = kNone;
};

/// Compares each relation with the estimates nearest to its two stamps, within the tolerance. An
/// estimate that is not finite errs infinitely.
RelationsMetric relations_metric(std::span<const EstimateSample> estimates,
                                 std::span<const Relation> relations,
                                 double join_tolerance_s = kJoinTolerance);

}  // namespace adit
