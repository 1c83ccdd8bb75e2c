#include "adit/matching/unary.hpp"

#include <algorithm>
#include <cmath>

namespace adit {
namespace {

// Every comparison is written so that not-a-number fails it.
bool within(double difference, double gate) { return std::abs(difference) <= gate; }

const Line* arm_of(const Corner& corner, std::size_t arm, const FeatureList& list) {
  const int index = corner.arms[arm];
  if (index < 0 || index >= static_cast<int>(list.lines.size())) return nullptr;
  return &list.lines[static_cast<std::size_t>(index)];
}

// The root of the squares of what the plan errs and `noise`, a squared deviation.
double slack(double map_error, double noise) { return std::sqrt(map_error * map_error + noise); }

// The sensed line as it is if it is the model line and the predicted heading good to `angerr`.
SteadiedLine steadied_by_prior(const LineView& sensed, const LineView& model,
                               const MatchingOptions& options) {
  return steady(sensed, turn_between(model.line->orientation, sensed.line->orientation),
                options.angerr * options.angerr + options.map_angerr * options.map_angerr);
}

bool shows_one_arm(const Corner& corner) { return (corner.arms[0] < 0) != (corner.arms[1] < 0); }

}  // namespace

bool corner_azimuths_agree(const CornerView& sensed, const CornerView& model) {
  return within(turn_between(model.azimuth, sensed.azimuth), sensed.azimuth_gate + model.parallax);
}

bool corner_distances_agree(const CornerView& sensed, const CornerView& model) {
  return within(sensed.distance - model.distance, sensed.distance_gate);
}

bool subtended_angles_overlap(const LineView& sensed, const LineView& model) {
  const double begin = model.begin_azimuth - model.begin_parallax - sensed.azimuth_gate;
  const double width =
      model.subtended + model.begin_parallax + model.end_parallax + 2.0 * sensed.azimuth_gate;
  // Two arcs overlap when the begin of one lies in the other.
  const double offset = wrap_positive(sensed.begin_azimuth - begin);
  return offset <= width || kTwoPi - offset <= sensed.subtended;
}

SlideRange allowed_slides(const LineView& sensed, const LineView& model,
                          const MatchingOptions& options) {
  const SteadiedLine steadied = steadied_by_prior(sensed, model, options);
  const double shorter =
      std::min(sensed.along_end - sensed.along_begin, model.along_end - model.along_begin);
  const double overlap = options.min_overlap * shorter;
  const double gate = options.poserr + slack(options.map_disterr, steadied.slide_noise);
  return {std::max(sensed.along_begin - model.along_end + overlap, -gate - steadied.slide),
          std::min(sensed.along_end - model.along_begin - overlap, gate - steadied.slide)};
}

bool extents_overlap(const LineView& sensed, const LineView& model,
                     const MatchingOptions& options) {
  const SlideRange slides = allowed_slides(sensed, model, options);
  return slides.low <= slides.high;
}

bool concave_angles_agree(const CornerView& sensed, const CornerView& model) {
  if (!sensed.corner->concave_angle || !model.corner->concave_angle) return true;
  return within(*sensed.corner->concave_angle - *model.corner->concave_angle, sensed.concave_gate);
}

bool bisectors_agree(const CornerView& sensed, const CornerView& model) {
  if (!sensed.corner->bisector || !model.corner->bisector) return true;
  return within(turn_between(*model.corner->bisector, *sensed.corner->bisector),
                sensed.bisector_gate);
}

bool line_orientations_agree(const LineView& sensed, const LineView& model) {
  return within(turn_between(model.line->orientation, sensed.line->orientation),
                sensed.orientation_gate);
}

bool line_distances_agree(const LineView& sensed, const LineView& model,
                          const MatchingOptions& options) {
  const double difference = sensed.line->distance - model.line->distance;
  if (options.consistency == Consistency::paper) {
    return within(difference, options.poserr + options.disterr);
  }
  const SteadiedLine steadied = steadied_by_prior(sensed, model, options);
  return within(difference + steadied.shift,
                options.poserr + slack(options.map_disterr, steadied.shift_noise));
}

bool visible_arms_agree(const Corner& sensed, const Corner& model) {
  if (!shows_one_arm(sensed) || !shows_one_arm(model)) return true;
  return (sensed.arms[0] < 0) == (model.arms[0] < 0);
}

bool arm_orientations_agree(const Corner& sensed, const FeatureList& sensed_list,
                            const Corner& model, const FeatureList& model_list,
                            const MatchingOptions& options) {
  if (sensed.bisector && model.bisector) return true;
  for (std::size_t arm = 0; arm < 2; ++arm) {
    const Line* of_sensed = arm_of(sensed, arm, sensed_list);
    const Line* of_model = arm_of(model, arm, model_list);
    if (of_sensed == nullptr || of_model == nullptr) continue;
    const double noise = noise_factor(options) * std::max(0.0, of_sensed->covariance(0, 0));
    const double gate = options.angerr + std::sqrt(options.map_angerr * options.map_angerr + noise);
    if (!within(turn_between(of_model->orientation, of_sensed->orientation), gate)) return false;
  }
  return true;
}

bool corners_may_match(const CornerView& sensed, const FeatureList& sensed_list,
                       const CornerView& model, const FeatureList& model_list,
                       const MatchingOptions& options) {
  if (!corner_distances_agree(sensed, model) || !corner_azimuths_agree(sensed, model) ||
      !bisectors_agree(sensed, model) || !concave_angles_agree(sensed, model)) {
    return false;
  }
  if (options.consistency == Consistency::paper) return true;
  return visible_arms_agree(*sensed.corner, *model.corner) &&
         arm_orientations_agree(*sensed.corner, sensed_list, *model.corner, model_list, options);
}

bool lines_may_match(const LineView& sensed, const LineView& model,
                     const MatchingOptions& options) {
  if (!line_orientations_agree(sensed, model) || !line_distances_agree(sensed, model, options)) {
    return false;
  }
  if (options.consistency == Consistency::clique && !extents_overlap(sensed, model, options)) {
    return false;
  }
  return subtended_angles_overlap(sensed, model);
}

}  // namespace adit
