#pragma once

#include <span>
#include <string>
#include <vector>

#include "adit/geometry/pose2.hpp"
#include "adit/geometry/result.hpp"
#include "adit/geometry/segment.hpp"
#include "adit/plot/style.hpp"

// Pictures of surveys. As in figures.hpp, each function writes one file.
namespace adit {

/// A surveyed wall to draw, and how sure its line is.
struct DrawnWall {
  Segment segment;
  double offset_sigma_m = 0.0;   ///< across, at the middle
  double angle_sigma_rad = 0.0;  ///< about the middle
};

/// Two poses of a survey's drive that were found to see the same place.
struct DrawnClosure {
  Vector2d from = Vector2d::Zero();
  Vector2d to = Vector2d::Zero();
};

/// A survey: its walls, the way of the drive or the stations, and what ties it together.
struct SurveyView {
  std::span<const DrawnWall> walls;
  std::span<const Pose2> trajectory;
  std::span<const Pose2> stations;  ///< drawn with their headings
  std::span<const DrawnClosure> closures;
};

/// What is drawn of a survey beside its walls.
struct SurveyPictureOptions {
  double band_sigmas = 3.0;

  template <class Self, class Field>
  static void visit(Self& self, Field&& field) {
    field("band_sigmas", self.band_sigmas,
          "half width of the bands around walls in standard deviations; 0 for none");
  }
};

/// The walls with bands of their uncertainty, the trajectory, the stations, the loop closures.
Result<void> draw_survey(const std::string& path, const SurveyView& view,
                         const PictureOptions& options = {},
                         const SurveyPictureOptions& survey = {});

/// What one change takes from a plan and adds to it.
struct DrawnChange {
  std::string name;  ///< of its kind, as the legend says
  std::vector<Segment> removed;
  std::vector<Segment> added;
};

/// A plan and what a survey would change of it, numbered as in the list of changes, from 1.
Result<void> draw_plan_changes(const std::string& path, std::span<const Segment> plan,
                               std::span<const DrawnChange> changes,
                               const PictureOptions& options = {});

}  // namespace adit
