#pragma once

#include <string>
#include <vector>

#include "adit/geometry/result.hpp"
#include "adit/io/plan_levels.hpp"
#include "adit/io/saved_pose.hpp"
#include "commands.hpp"
#include "configured.hpp"
#include "replay.hpp"

namespace adit {

/// How far a machine may have been moved between two runs, one sigma.
struct ResumeOptions {
  double moved_m = 0.25;
  double turned_rad = radians(4.0);

  template <class Self, class Field>
  static void visit(Self& self, Field&& field) {
    field("moved_m", self.moved_m, "a resumed machine may have been moved by this, one sigma (m)");
    field("turned_rad", self.turned_rad, "and turned by this (rad)");
  }
};

/// What the command says of the beginning of a run.
struct Start {
  Beginning beginning;
  std::string source;  ///< for the report: "given", "odometry", "anywhere", "resumed"
  std::string level;   ///< empty: not said
};

/// Reads `--start` or `--resume`, and `--level`. An Error without a file is one of the call.
Result<Start> start_of(const LocalizeArguments& arguments);

/// A saved pose as the beginning of a run: taken with its covariance grown, for nobody has watched
/// the machine since. One that was not known begins anywhere.
Beginning beginning_at(const SavedPose& saved, const ResumeOptions& options);

/// The level that a run is on: the one named, or the only one. None where that is for the scans to
/// say. An Error without a file is one of the call.
Result<std::optional<std::size_t>> level_of(const std::vector<PlanLevel>& plans,
                                            const Start& start);

}  // namespace adit
