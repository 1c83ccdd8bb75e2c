#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "adit/calibration/log_settings.hpp"
#include "adit/io/plan.hpp"
#include "adit/survey/plan_difference.hpp"
#include "adit/survey/walls.hpp"
#include "survey_call.hpp"

namespace adit {

/// Two scans, by number, that were found to show one place.
struct SurveyClosure {
  std::size_t earlier = 0;
  std::size_t later = 0;
  Pose2 earlier_from_later;
};

/// A survey's walls, where the vehicle was at every scan, and what both rest on.
struct Surveyed {
  LogSettings settings;
  LogSummary log;
  std::vector<StampedPose> trajectory;  ///< in the log's order
  std::size_t of_other_lasers = 0;      ///< scans that are in no wall: walls are those of laser 0
  WallMap walls;
  std::size_t keyframes = 0;  ///< of a drive; 0 of known positions
  std::size_t pairs = 0;
  std::vector<SurveyClosure> closures;
  std::vector<Pose2> stations;     ///< of known positions
  std::vector<Vector2d> unplaced;  ///< positions whose heading was not found
  std::size_t by_station = 0;  ///< scans without a pose of their stamp: they took their station's
  std::vector<Segment> plan;   ///< that is updated
  std::size_t places_in_plan = 0;  ///< scans that were found in it
  std::optional<PlanDifference> difference;
};

/// Reads what the call names, and surveys; shows progress on a terminal.
Result<Surveyed> survey_log(const SurveyArguments& arguments, const SurveyCall& call);

}  // namespace adit
