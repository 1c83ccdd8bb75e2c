#pragma once

#include "adit/localizer/belief.hpp"
#include "adit/localizer/fitter.hpp"
#include "adit/localizer/timings.hpp"
#include "adit/tracking/stamp_watch.hpp"

namespace adit {

/// What the last turn of the cycle worked with, for pictures, tests and reports; views the
/// localizer's buffers.
struct Turn {
  const PoseWithCovariance& predicted;  ///< map_from_vehicle, before the scan
  /// Model features are relative to the predicted position of the laser, in the map's axes; sensed
  /// ones are in the laser's frame.
  const FeatureList& model_features;
  const FeatureList& sensed_features;
  const MatchResult& match;
  const Extractor& extractor;
  const ScanFit& scan_fit;
  std::span<const WallShare> walls;  ///< what each wall contributed to that
  const MapError& map_error;         ///< as learnt so far
  const Hypotheses& hypotheses;      ///< poses of which any may be true; none unless it was lost
  const StampCounts& stamps;         ///< since the start
  const Timings& timings;
};

}  // namespace adit
