#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "adit/scan_motion/correlative_search.hpp"
#include "adit/survey/drift.hpp"
#include "adit/survey/drive_options.hpp"
#include "adit/survey/scan_tracker.hpp"

namespace adit {

/// A place seen again: where the later keyframe stands, seen from the earlier.
struct Closure {
  std::size_t from = 0;
  std::size_t to = 0;
  Pose2 from_to;
  Matrix3d information = Matrix3d::Zero();
  double score = 0.0;
};

/// The keyframes and their poses as known now; `drift` speaks of the same.
struct LoopScene {
  std::span<const Keyframe> keyframes;
  std::span<const Pose2> poses;
  const DriftBound& drift;
  double limit_m = 1.0;
};

/// All that looks like a place seen before, alone in its window, where none of `known` says so yet.
std::vector<Closure> search_loops(const LoopScene& scene, std::span<const Closure> known,
                                  const LoopOptions& options, const AlignmentOptions& alignment,
                                  int threads);

/// Closures that agree pairwise through the chain between them, with each other and with `known`,
/// which have been accepted before and stay; without those that too few others support.
///
/// The largest such set is hard to find (Mangelson et al. 2018); this one is grown greedily, from
/// the closure with most support on.
std::vector<Closure> consistent_set(const LoopScene& scene, std::span<const Closure> candidates,
                                    std::span<const Closure> known, const LoopOptions& options);

}  // namespace adit
